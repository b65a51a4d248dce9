// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "report/results.hpp"

#include <filesystem>
#include <string>

namespace cortex::profiler {

// A folder that is gone with the test.
class Folder {
public:
    Folder();
    ~Folder();
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;

    const std::filesystem::path& path() const { return path_; }
    std::string read(const std::string& file) const;
    void write(const std::string& file, const std::string& text) const;

private:
    std::filesystem::path path_;
};

Results sampleResults();  // something of everything; the values mean nothing

std::size_t count(const std::string& text, const std::string& part);

}  // namespace cortex::profiler
