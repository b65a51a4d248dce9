// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/type_model.hpp"

#include <string>
#include <vector>

namespace cortex::cli {

// What the skeletons of a new type's two files are made of.
struct NewTypeText {
    Type type;  // as it is when it adds nothing of its own
    std::vector<std::string> parents;
    std::string ontologyFile, morphologyFile;
    std::vector<std::string> ontologies;  // that declare the parents
    std::string model;                    // the file that has all types and rules
    std::string target;                   // type for an example of a relationship
};

std::string ontologyText(const NewTypeText& text);
std::string morphologyText(const NewTypeText& text);

}  // namespace cortex::cli
