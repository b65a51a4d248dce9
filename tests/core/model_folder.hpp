// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/model_files.hpp"
#include "cortex/core/simplex_tree.hpp"

#include <filesystem>
#include <memory>
#include <string>

namespace cortex::test {

// A folder of its own for the model files of one test, removed at its end.
class ModelFolder {
public:
    ModelFolder();
    ~ModelFolder();
    ModelFolder(const ModelFolder&) = delete;
    ModelFolder& operator=(const ModelFolder&) = delete;

    std::filesystem::path write(const std::string& name, const std::string& text) const;
    std::string read(const std::string& name) const;
    void copyOntology() const;  // every shipped file
    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

std::string textOf(const std::filesystem::path& file);

// The system file of the case study with the parts that it includes written into it.
std::string caseStudy();

// What an agent or `cortex validate` makes of files: everything found, and the tree.
struct CheckedModel {
    Report report;
    std::unique_ptr<SimplexTree> tree;

    const Finding* find(const std::string& rule) const;  // the first of that rule
    std::size_t count(const std::string& rule) const;
};
CheckedModel check(const std::filesystem::path& file);

// A small ontology with one type or rule for each thing that validation looks at, and the model of
// a system of it, given as the elements inside <system>.
TypeModel smallTypes();
CheckedModel checkSmall(const std::string& elements);

// Those elements as text, an element a line.
std::string simplex(const std::string& path, const std::string& type,
                    const std::string& inside = "", const std::string& attributes = "");
std::string relate(const std::string& rule, const std::string& to, const std::string& more = "");
std::string set(const std::string& item, const std::string& value);

// The only finding of a model, or one that holds the whole report.
Finding only(const CheckedModel& checked);
bool contains(const std::string& text, const std::string& part);

}  // namespace cortex::test
