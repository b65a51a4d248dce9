// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/agreement.hpp"
#include "cortex/core/model_files.hpp"

#include "fuzz_file.hpp"

// Any text as an ontology file: a report or a model, and a model agrees with itself.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const cortex::fuzz::Folder folder;
    const std::filesystem::path files[] = {folder.write("in.xml", cortex::fuzz::text(data, size))};
    cortex::Report report;

    const cortex::ModelFiles model = cortex::readModelFiles(files, report);

    for (const auto& [name, type] : model.types.types()) {
        if (cortex::canonicalText(type).empty()) std::abort();
    }
    if (!cortex::compare(model.types, model.types).empty()) std::abort();
    for (const cortex::Finding& finding : report.findings) {
        if (finding.rule.empty() || finding.message.empty()) std::abort();
    }
    return 0;
}
