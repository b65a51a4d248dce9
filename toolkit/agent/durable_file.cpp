// SPDX-License-Identifier: Apache-2.0
#include "durable_file.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <iostream>
#include <utility>

#include <fcntl.h>
#include <unistd.h>

namespace cortex::toolkit {
namespace {

namespace fs = std::filesystem;

fs::path folderOf(const fs::path& file) {
    return file.has_parent_path() ? file.parent_path() : fs::path{"."};
}

std::string failed(const fs::path& file) { return file.string() + ": " + std::strerror(errno); }

}  // namespace

OpenFile::OpenFile(const fs::path& path, int flags)
    : file_{open(path.c_str(), flags | O_CLOEXEC, 0644)} {}

OpenFile::OpenFile(OpenFile&& other) noexcept : file_{std::exchange(other.file_, -1)} {}

OpenFile& OpenFile::operator=(OpenFile&& other) noexcept {
    if (this != &other) {
        close();
        file_ = std::exchange(other.file_, -1);
    }
    return *this;
}

bool OpenFile::writeAll(std::string_view text) const {
    while (file_ >= 0 && !text.empty()) {
        const ssize_t size = ::write(file_, text.data(), text.size());
        if (size < 0 && errno != EINTR) return false;
        if (size > 0) text.remove_prefix(static_cast<std::size_t>(size));
    }
    return file_ >= 0;
}

bool OpenFile::sync() const { return file_ >= 0 && fsync(file_) == 0; }

void OpenFile::close() {
    if (file_ >= 0) ::close(std::exchange(file_, -1));
}

std::string otherThanAFile(const fs::path& path) {
    std::error_code none;
    switch (fs::symlink_status(path, none).type()) {
        case fs::file_type::regular:
        case fs::file_type::not_found:
            return "";
        case fs::file_type::symlink:
            return path.string() + " is a symbolic link, which would be replaced: name the file";
        case fs::file_type::directory:
            return path.string() + " is a folder: name a file in it";
        default:
            return path.string() +
                   " is no regular file, and would be replaced by one: name another file";
    }
}

std::string missingFolder(const fs::path& file) {
    const fs::path folder = folderOf(file);
    std::error_code none;
    if (fs::exists(folder, none)) return "";
    return "the folder " + folder.string() + " is missing: mkdir -p " + folder.string() +
           ", and it goes on within a second";
}

std::string putInPlace(const fs::path& next, const fs::path& file) {
    if (std::rename(next.c_str(), file.c_str()) != 0) return failed(file);
    return OpenFile{folderOf(file), O_RDONLY | O_DIRECTORY}.sync() ? "" : failed(file);
}

std::string replaceFile(const fs::path& file, const std::string& text) {
    const fs::path next = file.string() + ".new";
    if (std::string other = otherThanAFile(file); !other.empty()) return other;
    if (std::string missing = missingFolder(file); !missing.empty()) return missing;
    {
        const OpenFile output{next, O_WRONLY | O_CREAT | O_TRUNC | O_NOFOLLOW};
        if (!output.writeAll(text) || !output.sync()) return failed(file);
    }
    return putInPlace(next, file);
}

WriteTrouble::WriteTrouble(std::string what, fs::path file)
    : what_{std::move(what)}, file_{std::move(file)} {}

void WriteTrouble::tell(const std::string& problem) {
    if (problem != problem_ && !problem.empty()) {
        std::cerr << what_ << " not written: " << problem << std::endl;
    } else if (!problem_.empty() && problem.empty()) {
        std::cerr << what_ << " written again: " << file_.string() << std::endl;
    }
    problem_ = problem;
}

}  // namespace cortex::toolkit
