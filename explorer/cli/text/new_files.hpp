// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "text/output.hpp"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace cortex::cli {

struct NewFile {
    std::filesystem::path file;
    std::string text;
};

struct NewFileOptions {
    std::filesystem::path output;  // empty: standard output
    bool force = false;
    bool json = false;
};

// Throws Failure, with what to do, unless there is the folder of the file.
void checkFolder(const std::filesystem::path& file);

// Writes the files, or prints them where no output is named. Throws Failure, with none of them
// touched, if one exists and force is off.
void deliver(const std::vector<NewFile>& files, const NewFileOptions& options);

// `{name}` in the text becomes its value; one that is not listed stays.
struct Substitution {
    std::string_view name;
    std::string value;
};
std::string filledIn(std::string_view text, const std::vector<Substitution>& substitutions);

std::string xmlComment(std::string_view text);  // what may stand in a comment

// Of a wrong name that is a file's: where that belongs.
std::string fileNameHint(std::string_view name);

}  // namespace cortex::cli
