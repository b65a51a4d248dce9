// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace cortex::toolkit {

// A descriptor that is closed with its object. False where it could not be opened: errno.
class OpenFile {
public:
    OpenFile() = default;
    OpenFile(const std::filesystem::path& path, int flags);  // and O_CLOEXEC
    ~OpenFile() { close(); }
    OpenFile(OpenFile&& other) noexcept;
    OpenFile& operator=(OpenFile&& other) noexcept;

    explicit operator bool() const { return file_ >= 0; }
    int number() const { return file_; }
    // False: errno says why.
    bool writeAll(std::string_view text) const;
    bool sync() const;
    void close();

private:
    int file_ = -1;
};

// Why nothing may be written there: a new file takes the place of the old one, of /dev/null as
// well, where we may do so. "" where it is a file or nothing.
std::string otherThanAFile(const std::filesystem::path& path);

std::string missingFolder(const std::filesystem::path& file);  // "" where it is there

// In one step `next`, which is on the disk, becomes `file`. "" or why not.
std::string putInPlace(const std::filesystem::path& next, const std::filesystem::path& file);

// After a power failure the file is the old or the new one. "" or why it is the old.
std::string replaceFile(const std::filesystem::path& file, const std::string& text);

// Says on the standard error what is not written, once for each reason, and when it is again.
class WriteTrouble {
public:
    // "retained items are"
    WriteTrouble(std::string what, std::filesystem::path file);
    void tell(const std::string& problem);  // "": there is none

private:
    std::string what_, problem_;
    std::filesystem::path file_;
};

}  // namespace cortex::toolkit
