// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/model_files.hpp"

#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace cortex::test {

// What was read from files of a test's own; places name the files without their folder.
struct XmlModel {
    Report report;
    ModelFiles files;

    const Type& type(const std::string& name) const { return files.types.at(name); }
    const DataItem& data(const std::string& type, const std::string& item) const {
        return *files.types.at(type).findData(item);
    }
    const Rule& rule(const std::string& type, const std::string& rule) const {
        return *files.types.at(type).findRule(rule);
    }
    std::string text() const { return report.text(); }
};

// Reads the first of the files; the others may be included by it.
XmlModel readFiles(const std::vector<std::pair<std::string, std::string>>& files);

// Elements inside of <ontology name="t"> (file t.xml, which begins at line 1 with them) and inside
// of <morphology name="m"> (file m.xml likewise).
XmlModel readTypes(const std::string& types, const std::string& rules = "");

// One finding and no other: its rule, its path and its line.
testing::AssertionResult finds(const XmlModel& model, const std::string& rule,
                               const std::string& path, int line, const std::string& words = "");
testing::AssertionResult isValid(const XmlModel& model);

}  // namespace cortex::test
