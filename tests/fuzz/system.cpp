// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/agent.hpp"
#include "cortex/core/error.hpp"
#include "cortex/core/make_structure.hpp"
#include "cortex/core/validation.hpp"

#include "fuzz_file.hpp"

// Any text as a system file: refused in words, or a tree that validates or tells what is wrong.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const cortex::fuzz::Folder folder;
    static const std::filesystem::path types = folder.write("types.xml", cortex::fuzz::types);
    static const std::filesystem::path rules = folder.write("rules.xml", cortex::fuzz::rules);
    const std::filesystem::path files[] = {folder.write("in.xml", cortex::fuzz::text(data, size))};
    try {
        cortex::SimplexTree tree = cortex::SimplexTree::load(files);
        tree.createRelated();
        if (cortex::validate(tree).ok()) cortex::makeStructure("fuzz", tree);
    } catch (const cortex::ModelError& error) {
        if (error.report().ok()) std::abort();
    }
    return 0;
}
