// SPDX-License-Identifier: Apache-2.0
#include "text/new_files.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <iostream>
#include <memory>

namespace cortex::cli {
namespace {

namespace fs = std::filesystem;

void checkAbsent(const fs::path& file) {
    std::error_code ignored;
    if (!fs::exists(fs::symlink_status(file, ignored))) return;
    throw Failure{
        No, "'" + file.string() + "' exists; give another name to -o, or --force to replace it"};
}

[[noreturn]] void cannotWrite(const fs::path& file) {
    throw Failure{No, "cannot write '" + file.string() + "': " + std::strerror(errno)};
}

// With "x" the system itself refuses a file that has come to exist since it was looked for.
void writeFile(const NewFile& file, bool force) {
    struct Close {
        void operator()(std::FILE* stream) const { std::fclose(stream); }
    };
    const std::unique_ptr<std::FILE, Close> stream{
        std::fopen(file.file.c_str(), force ? "w" : "wx")};
    if (stream == nullptr) cannotWrite(file.file);
    const bool written =
        std::fwrite(file.text.data(), 1, file.text.size(), stream.get()) == file.text.size();
    if (!written || std::fflush(stream.get()) != 0) cannotWrite(file.file);
}

}  // namespace

void checkFolder(const fs::path& file) {
    const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path{"."};
    std::error_code ignored;
    if (fs::is_directory(folder, ignored)) return;
    throw Failure{NotFound, "there is no folder '" + folder.string() +
                                "'; make it first: mkdir -p " + folder.string()};
}

void deliver(const std::vector<NewFile>& files, const NewFileOptions& options) {
    const bool toFiles = !options.output.empty();
    for (const NewFile& file : files) {
        if (toFiles) checkFolder(file.file);
        if (toFiles && !options.force) checkAbsent(file.file);
    }
    Json list = Json::array();
    for (const NewFile& file : files) {
        if (toFiles) writeFile(file, options.force);
        list.push_back({{"file", file.file.string()}, {"written", toFiles}, {"text", file.text}});
        if (options.json) continue;
        if (toFiles) {
            std::cout << "wrote " << printable(file.file.string()) << '\n';
        } else {
            std::cout << (&file == &files.front() ? "" : "\n") << file.text;
        }
    }
    if (options.json) print({{"files", list}});
}

std::string filledIn(std::string_view text, const std::vector<Substitution>& substitutions) {
    std::string result;
    while (!text.empty()) {
        const auto found = std::ranges::find_if(substitutions, [&](const Substitution& each) {
            return text.starts_with('{') && text.substr(1).starts_with(each.name) &&
                   text.substr(1 + each.name.size()).starts_with('}');
        });
        if (found == substitutions.end()) {
            result += text.front();
            text.remove_prefix(1);
        } else {
            result += found->value;
            text.remove_prefix(found->name.size() + 2);
        }
    }
    return result;
}

std::string fileNameHint(std::string_view name) {
    return name.ends_with(".xml") ? "; a file is named by -o" : "";
}

std::string xmlComment(std::string_view text) {
    std::string result;
    for (const char c : text) {
        if (c == '-' && result.ends_with('-')) result += ' ';
        result += c;
    }
    return result;
}

}  // namespace cortex::cli
