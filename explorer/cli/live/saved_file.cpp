// SPDX-License-Identifier: Apache-2.0
#include "live/saved_file.hpp"

#include "cortex/core/model_files.hpp"
#include "cortex/core/xml_text.hpp"

#include "models/model.hpp"
#include "text/new_files.hpp"

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include <sys/stat.h>
#include <unistd.h>

namespace cortex::cli {
namespace {

namespace fs = std::filesystem;

bool writeAll(int handle, std::string_view text) {
    while (!text.empty()) {
        const ssize_t written = write(handle, text.data(), text.size());
        if (written < 0 && errno != EINTR) return false;
        if (written > 0) text.remove_prefix(static_cast<std::size_t>(written));
    }
    return fsync(handle) == 0;
}

}  // namespace

std::string savedText(const std::vector<SavedSimplex>& simplexes, const std::string& title) {
    std::string text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<!-- " + xmlComment(title) +
                       " -->\n<system name=\"saved\">\n";
    for (const SavedSimplex& simplex : simplexes) {
        text += "  <simplex path=\"" + simplex.path + "\" type=\"" + simplex.type + "\">\n";
        for (const SavedItem& item : simplex.items) {
            if (!item.wrong.empty()) {
                text += "    <!-- not saved: " + xmlComment(printable(item.wrong)) + " -->\n";
                continue;
            }
            text += "    " + setElement(item.name, item.value);
            if (!item.note.empty()) text += "  <!-- " + xmlComment(item.note) + " -->";
            text += '\n';
        }
        text += "  </simplex>\n";
    }
    return text + "</system>\n";
}

void refuseExisting(const std::string& file) {
    std::error_code ignored;
    if (!fs::exists(fs::symlink_status(file, ignored))) return;
    throw Failure{No, "'" + file + "' exists; give another name, or --force to replace it"};
}

void writeSaved(const fs::path& file, const std::string& text) {
    std::error_code ignored;
    const fs::file_status there = fs::symlink_status(file, ignored);
    if (fs::exists(there) && !fs::is_regular_file(there)) {
        throw Failure{No, "'" + file.string() +
                              "' is no regular file, and would be replaced by "
                              "one: name another file"};
    }
    std::string name = file.string() + ".XXXXXX";
    const auto fail = [&] {
        throw Failure{No, "cannot write '" + file.string() + "': " + std::strerror(errno)};
    };
    const int handle = mkstemp(name.data());
    if (handle < 0) fail();
    const mode_t mask = umask(0);
    umask(mask);
    fchmod(handle, 0666 & ~mask);  // as any new file has it
    const bool written = writeAll(handle, text);
    close(handle);
    if (!written || std::rename(name.c_str(), file.c_str()) != 0) {
        const int reason = errno;
        unlink(name.c_str());
        errno = reason;
        fail();
    }
}

std::vector<SavedSimplex> readSaved(const fs::path& file) {
    Report report;
    const ModelFiles read = readModelFiles(std::array{file}, report);
    if (report.ok() && !read.hasSystem) {
        throw Failure{No, "'" + file.string() + "' was not written by 'cortex save'"};
    }
    if (!report.ok()) {
        throw Failure{lacksFile(report) ? NotFound : No, "the file has errors", std::move(report)};
    }
    std::vector<SavedSimplex> simplexes;
    for (const auto& entry : read.system.simplexes) {
        SavedSimplex& simplex = simplexes.emplace_back();
        simplex = {entry.path, entry.type, {}, entry.place};
        for (const auto& setting : entry.settings) {
            simplex.items.push_back({setting.data, setting.value, "", "", setting.place});
        }
    }
    return simplexes;
}

}  // namespace cortex::cli
