// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/agreement.hpp"
#include "cortex/core/model_files.hpp"

#include "fuzz_file.hpp"

// Any text as a morphology file on top of a small ontology ("types.xml", included or not).
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const cortex::fuzz::Folder folder;
    static const std::filesystem::path types = folder.write("types.xml", cortex::fuzz::types);
    const std::filesystem::path files[] = {types,
                                           folder.write("in.xml", cortex::fuzz::text(data, size))};
    cortex::Report report;

    const cortex::ModelFiles model = cortex::readModelFiles(files, report);

    if (model.types.find("Sine") == nullptr && report.ok()) std::abort();
    if (!cortex::compare(model.types, model.types).empty()) std::abort();
    return 0;
}
