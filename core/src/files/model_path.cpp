// SPDX-License-Identifier: Apache-2.0
#include "files/model_path.hpp"

#include "cortex/core/findings.hpp"

#include "base/bounds.hpp"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <string_view>
#include <vector>

#include <dlfcn.h>

namespace cortex {

namespace {

namespace fs = std::filesystem;

// share/cortex beside the library that this code is in, wherever it was installed to. The loader
// may name the library by a link to its folder: where /lib is a link, /lib/../share is not
// /usr/share.
fs::path shareFolder() {
    Dl_info library{};
    if (dladdr(reinterpret_cast<const void*>(&findModelFile), &library) == 0) return {};
    const fs::path folder = fs::path{library.dli_fname}.parent_path();
    std::error_code failed;
    const fs::path real = fs::canonical(folder, failed);
    return ((failed ? folder : real) / CORTEX_SHARE_FROM_LIBRARY).lexically_normal();
}

std::vector<fs::path> searchFolders() {
    std::vector<fs::path> folders;
    const char* variable = std::getenv("CORTEX_PATH");
    std::string_view rest = variable ? variable : "";
    while (!rest.empty()) {
        const std::size_t end = std::min(rest.find(':'), rest.size());
        if (end > 0) folders.emplace_back(rest.substr(0, end));
        rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    folders.push_back(shareFolder());
    return folders;
}

}  // namespace

FoundFile findModelFile(const fs::path& file, const std::string& includedFrom) {
    std::vector<fs::path> candidates{
        includedFrom.empty() ? file : fs::path{includedFrom}.parent_path() / file};
    if (file.is_relative()) {
        for (const fs::path& folder : searchFolders()) candidates.push_back(folder / file);
    }
    FoundFile result;
    for (const fs::path& candidate : candidates) {
        std::error_code ignored;
        const fs::path normal = candidate.lexically_normal();
        if (fs::exists(normal, ignored) && !fs::is_directory(normal, ignored)) {
            result.file = normal;
            return result;
        }
        result.lookedFor += (result.lookedFor.empty() ? "" : ", ") + normal.string().substr(0, 200);
    }
    return result;
}

std::optional<std::string> readModelFile(const fs::path& file, std::size_t octetsLeft,
                                         Report& report) {
    const std::size_t most = std::min(bounds::fileSize, octetsLeft);
    std::error_code failed;
    const bool regular = fs::is_regular_file(file, failed);
    std::string content;
    if (regular) {
        std::ifstream stream{file, std::ios::binary};
        content.resize(std::min<std::size_t>(fs::file_size(file, failed), most + 1));
        stream.read(content.data(), static_cast<std::streamsize>(content.size()));
        if (failed || !stream) {
            report.error("", finding::fileMissing, {file.string(), 0}, "the file cannot be read",
                         "check its permissions");
            return std::nullopt;
        }
    } else {
        report.error("", finding::fileMissing, {file.string(), 0}, "this is not a regular file",
                     "give the name of an XML file");
        return std::nullopt;
    }
    if (content.size() <= most) return content;
    report.error("", finding::fileSize, {file.string(), 0},
                 "the file is larger than 16 MiB, or all files together than 64 MiB",
                 "divide the model and read less of it at once");
    return std::nullopt;
}

}  // namespace cortex
