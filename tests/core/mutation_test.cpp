// SPDX-License-Identifier: Apache-2.0
#include "core/mutation.hpp"

#include <algorithm>
#include <vector>

#include <stdlib.h>

#include <gtest/gtest.h>

namespace cortex::test {
namespace {

std::vector<Mutation> allMutations() {
    std::vector<Mutation> all = mutationsOfSystems();
    const auto types = mutationsOfTypes();
    all.insert(all.end(), types.begin(), types.end());
    return all;
}

class ShippedFiles : public testing::TestWithParam<Mutation> {};

// The one finding that a mutation is for, or null.
const Finding* findingOf(const Mutation& mutation, const CheckedModel& model) {
    const auto found = std::ranges::find_if(model.report.findings, [&](const Finding& finding) {
        return finding.rule == mutation.rule && finding.path == mutation.path;
    });
    return found != model.report.findings.end() ? &*found : nullptr;
}

std::string schemaOf(const std::string& file) {
    if (file.find("morphology") != std::string::npos) return "morphology.xsd";
    return file == systemFile ? "system.xsd" : "ontology.xsd";
}

bool schemaTakes(const ModelFolder& folder, const std::string& file) {
    const std::string at = folder.path().string() + "/";
    const std::string command = "xmllint --nonet --noout --schema '" + at + schemaOf(file) + "' '" +
                                at + file + "' >/dev/null 2>&1";
    return std::system(command.c_str()) == 0;
}

TEST(ShippedFiles, AreValid) {
    const ModelFolder folder;
    copyShipped(folder);

    const auto model = check(folder.path() / systemFile);

    EXPECT_EQ(model.report.text(), "");
}

TEST(ShippedFiles, PassTheirSchemas) {
    const ModelFolder folder;
    copyShipped(folder);

    for (const char* file :
         {"base.xml", "base-morphology.xml", ontologyFile, morphologyFile, systemFile}) {
        EXPECT_TRUE(schemaTakes(folder, file)) << file;
    }
}

TEST_P(ShippedFiles, AreRefusedWhenMutated) {
    const Mutation& mutation = GetParam();
    const ModelFolder folder;
    copyShipped(folder);
    const std::string original = folder.read(mutation.file);
    folder.write(mutation.file, replaced(original, mutation.before, mutation.after));

    const auto model = check(folder.path() / systemFile);

    const Finding* finding = findingOf(mutation, model);
    ASSERT_NE(finding, nullptr) << model.report.text();
    const bool here = mutation.atFile == nullptr;
    const std::string file = here ? mutation.file : mutation.atFile;
    const std::size_t length = here ? std::string_view{mutation.after}.size() : 0;
    EXPECT_EQ(finding->place.file, file);
    EXPECT_EQ(finding->place.line, lineOf(folder.read(file), mutation.at,
                                          here ? original.find(mutation.before) : 0, length))
        << finding->text();
    EXPECT_EQ(finding->severity, mutation.severity);
    EXPECT_FALSE(finding->remedy.empty()) << finding->text();
    if (mutation.structural) {
        EXPECT_FALSE(schemaTakes(folder, mutation.file));
    }
    if (mutation.remedy == Remedy::None) return;

    applyRemedy(folder, *finding, mutation.remedy);

    EXPECT_EQ(check(folder.path() / systemFile).report.text(), "") << finding->text();
}

INSTANTIATE_TEST_SUITE_P(Mutations, ShippedFiles, testing::ValuesIn(allMutations()),
                         [](const auto& each) { return std::string{each.param.name}; });

TEST(ShippedFiles, AreMutatedInFortyKindsHalfOfThemMendedByTheRemedy) {
    const auto mutations = allMutations();
    const auto mended = std::ranges::count_if(
        mutations, [](const Mutation& each) { return each.remedy != Remedy::None; });

    EXPECT_GE(mutations.size(), 40U);
    EXPECT_GE(static_cast<std::size_t>(mended), mutations.size() / 2);
}

}  // namespace
}  // namespace cortex::test
