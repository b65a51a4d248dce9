// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "live/live.hpp"
#include "models/model.hpp"
#include "text/new_files.hpp"
#include "text/output.hpp"

#include <optional>
#include <string>
#include <vector>

// The verbs of the program, each with what its options say. They print and return the exit code, or
// throw Failure.
namespace cortex::cli {

struct ValidateOptions {
    Paths files;
    Paths plugins;           // with classes of active types
    bool modelOnly = false;  // for programs with classes of their own
    bool json = false;
};
Exit validateFiles(const ValidateOptions& options);

struct DiffOptions {
    std::filesystem::path ours, theirs;
    bool json = false;
};
Exit diffModels(const DiffOptions& options);

// Where the model comes from: files, or without any the agents on a network.
struct TypesOptions {
    std::optional<std::string> type;  // none: all
    Paths files;
    NetworkArguments network;
    bool json = false;
};
Exit showTypes(const TypesOptions& options);

struct GraphOptions {
    Paths files;
    NetworkArguments network;
    bool dot = false;
    bool json = false;
};
Exit showGraph(const GraphOptions& options);

struct NewTypeOptions : NewFileOptions {
    std::string name;
    std::vector<std::string> parents;
    std::filesystem::path file;
};
Exit newType(const NewTypeOptions& options);

struct NewSystemOptions : NewFileOptions {
    std::string name;
};
Exit newSystem(const NewSystemOptions& options);

}  // namespace cortex::cli
