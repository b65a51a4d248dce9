// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/report.hpp"

#include "core/model_folder.hpp"

#include <ostream>
#include <string>
#include <string_view>
#include <vector>

namespace cortex::test {

// How the XML that a remedy prints is put into the file at the place of its finding.
enum class Remedy {
    None,         // not applied here
    Replace,      // the element is replaced by the one printed
    Insert,       // the elements printed go into the <simplex>
    Add,          // the <simplex> printed goes into the system, the rest as Insert
    Remove,       // the element is removed
    Attribute,    // the attribute printed is written into the element
    AttributeAt,  // … into the element at the place that the remedy names
    Nearest,      // the first of the nearest names stands for the wrong one
};

// One change of one shipped file, and what must be said of it.
struct Mutation {
    const char* name;
    const char* file;
    const char* before;  // stands once in the file
    const char* after;
    const char* rule;
    const char* path;
    const char* at;                // text on the line of the finding, in the mutated file
    const char* atFile = nullptr;  // null: the mutated one
    Remedy remedy = Remedy::None;
    bool structural = false;  // refused by the schema too
    Severity severity = Severity::Error;
};
std::ostream& operator<<(std::ostream& stream, const Mutation& mutation);

inline constexpr char systemFile[] = "lbr_teleop.xml";
inline constexpr char ontologyFile[] = "robotics.xml";
inline constexpr char morphologyFile[] = "robotics-morphology.xml";

std::vector<Mutation> mutationsOfSystems();
std::vector<Mutation> mutationsOfTypes();  // of types and rules, and of the form of the files

// The shipped files side by side: the ontology, and the case study that uses it.
void copyShipped(const ModelFolder& folder);

std::string replaced(const std::string& text, std::string_view before, std::string_view after);
// Line of `at`: the last in the `length` octets changed at `changed`, else the first in the text.
int lineOf(const std::string& text, std::string_view at, std::size_t changed, std::size_t length);

void applyRemedy(const ModelFolder& folder, const Finding& finding, Remedy remedy);

}  // namespace cortex::test
