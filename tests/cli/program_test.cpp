// SPDX-License-Identifier: Apache-2.0
#include "cli/cortex_process.hpp"
#include "cli/json_schema.hpp"
#include "core/model_folder.hpp"

#include <gtest/gtest.h>

namespace cortex::test {
namespace {

using nlohmann::json;

const std::vector<std::string> verbs{
    "validate", "diff",  "types", "graph", "new-type", "new-system", "agents", "list",
    "show",     "watch", "call",  "set",   "leases",   "people",     "events", "conform"};

TEST(CortexProgram, ExplainsEveryVerbWithAnExample) {
    const Outcome all = cortex({"--help"});
    EXPECT_EQ(all.exit, 0);
    EXPECT_NE(all.output.find("Exit codes: 0 yes"), std::string::npos) << all.output;
    for (const std::string& verb : verbs) {
        EXPECT_NE(all.output.find("\n  " + verb + " "), std::string::npos) << all.output;
        const Outcome one = cortex({verb, "--help"});
        EXPECT_EQ(one.exit, 0) << verb;
        EXPECT_NE(one.output.find("  cortex " + verb), std::string::npos) << one.output;
        EXPECT_NE(one.output.find("--json"), std::string::npos) << one.output;
        EXPECT_EQ(one.errors, "");
    }
}

TEST(CortexProgram, EndsWith2ForWrongUsage) {
    const std::vector<std::vector<std::string>> wrong{{},
                                                      {"validate"},
                                                      {"validate", "--nonsense", "x.xml"},
                                                      {"diff", "a"},
                                                      {"--nonsense"},
                                                      {"types", "A", "B", "--file", "x"},
                                                      {"new-system", "-o"}};
    for (const auto& arguments : wrong) {
        const Outcome outcome = cortex(arguments);
        EXPECT_EQ(outcome.exit, 2) << outcome.errors;
        EXPECT_EQ(outcome.output, "");
        EXPECT_NE(outcome.errors, "");
    }
}

TEST(CortexProgram, NamesTheNearestOfAnUnknownVerb) {
    const Outcome outcome = cortex({"vlaidate", "x.xml"});

    EXPECT_EQ(outcome.exit, 2);
    EXPECT_NE(outcome.errors.find("nearest of: validate"), std::string::npos) << outcome.errors;
}

TEST(CortexProgram, NamesTheNearestOfAnUnknownOption) {
    const std::vector<std::pair<std::vector<std::string>, std::string>> wrong{
        {{"--vesion"}, "there is no option '--vesion'; nearest of: --version"},
        {{"validate", "--JSON", "x.xml"}, "there is no option '--JSON'; nearest of: --json"},
        {{"new-type", "Pump", "--extend=Device"}, "'--extend'; nearest of: --extends"},
        {{"graph", "-x"}, "there are --help, --json, --dot, --file"},
        {{"--json", "graph"}, "before the verb; there are --help, --version; those of a verb"}};
    for (const auto& [arguments, message] : wrong) {
        const Outcome outcome = cortex(arguments);
        EXPECT_EQ(outcome.exit, 2);
        EXPECT_NE(outcome.errors.find(message), std::string::npos) << outcome.errors;
        EXPECT_NE(outcome.errors.find("\nhelp: cortex "), std::string::npos) << outcome.errors;
    }
}

TEST(CortexProgram, SaysWhereTheNameOfAFileBelongs) {
    const ModelFolder folder;
    folder.write("there", "");
    const std::vector<std::pair<std::vector<std::string>, std::string>> wrong{
        {{"graph", "there"}, "'there' was not expected; did you mean --file there?"},
        {{"graph", "a.xml", "b.xml"}, "; did you mean --file a.xml b.xml?"},
        {{"graph", "word"}, "'word' was not expected\n"},
        {{"types", "there"}, "'there' is a file, not a type; did you mean --file there?"},
        {{"types", "KukaLbr", "x.xml"}, "'x.xml' was not expected; did you mean --file x.xml?"},
        {{"validate", "--file", "there"}, "no option '--file' here: name the files without it"},
        {{"diff", "-f", "a.xml", "b.xml"}, "no option '-f' here: name the files without it"},
        {{"new-system", "plant.xml"}, "; a file is named by -o"},
        {{"new-type", "Pump.xml", "--extends", "Device"}, "; a file is named by -o"}};
    for (const auto& [arguments, message] : wrong) {
        const Outcome outcome = cortex(arguments, {}, folder.path());
        EXPECT_EQ(outcome.exit, 2);
        EXPECT_NE(outcome.errors.find(message), std::string::npos) << outcome.errors;
    }
}

TEST(CortexProgram, PrintsItsVersion) {
    const Outcome outcome = cortex({"--version"});

    EXPECT_EQ(outcome.exit, 0);
    EXPECT_EQ(outcome.output.find("cortex "), 0U) << outcome.output;
}

TEST(CortexProgram, SaysThatItsOutputIsFull) {
    const Outcome outcome = runProgram(
        "sh", {"-c", "exec \"$0\" new-system >/dev/full", CORTEX_BINARY_DIR "/bin/cortex"});

    EXPECT_EQ(outcome.exit, 1);
    EXPECT_NE(outcome.errors.find("cannot write to standard output"), std::string::npos);
}

// A locale with a decimal comma and grouping, made for the test.
TEST(CortexProgram, ReadsAndWritesNumbersTheSameInEveryLocale) {
    const ModelFolder folder;
    const std::string german = (folder.path() / "de_DE.UTF-8").string();
    ASSERT_EQ(runProgram("localedef", {"-i", "de_DE", "-f", "UTF-8", german}).exit, 0);
    const std::map<std::string, std::string> environment{
        {"LOCPATH", folder.path().string()}, {"LC_ALL", "de_DE.UTF-8"}, {"LANGUAGE", "de"}};
    ASSERT_EQ(runProgram("locale", {"decimal_point"}, environment).output, ",\n");
    folder.write("t.xml",
                 "<ontology name=\"t\" version=\"1.0\"><type name=\"A\">"
                 "<data name=\"x\" kind=\"float\" min=\"0.5\" max=\"1234567.25\" default=\"1.5\"/>"
                 "<data name=\"n\" kind=\"int\" default=\"1234567\"/></type></ontology>");

    for (const bool asJson : {false, true}) {
        std::vector<std::string> arguments{"types", "A", "--file", "t.xml"};
        if (asJson) arguments.push_back("--json");
        const Outcome there = cortex(arguments, environment, folder.path());
        EXPECT_EQ(there.exit, 0) << there.errors;
        EXPECT_EQ(there.output, cortex(arguments, {{"LC_ALL", "C"}}, folder.path()).output);
        EXPECT_NE(there.output.find("1234567.25"), std::string::npos) << there.output;
    }
}

TEST(JsonSchema, FindsWhatAValueBreaks) {
    const json schema = json::parse(R"({"type": "object", "required": ["a"],
        "additionalProperties": false, "properties": {"a": {"type": "integer", "minimum": 0},
        "b": {"type": "array", "items": {"$ref": "#/$defs/word"}}},
        "$defs": {"word": {"type": ["string", "null"], "pattern": "^x", "enum": ["x", "xy", null]}}})");

    EXPECT_TRUE(violations(schema, json::parse(R"({"a": 1, "b": ["x", null]})")).empty());
    for (const char* wrong :
         {R"({})", R"({"a": "1"})", R"({"a": -1})", R"({"a": 1.5})", R"([])", R"({"a": 1, "c": 1})",
          R"({"a": 1, "b": ["y"]})", R"({"a": 1, "b": ["xz"]})", R"({"a": 1, "b": 1})"}) {
        EXPECT_FALSE(violations(schema, json::parse(wrong)).empty()) << wrong;
    }
    EXPECT_FALSE(violations(json::parse(R"({"maximum": 1})"), 1).empty());
    EXPECT_NE(violationsOf("validate", "no json"), "");
}

}  // namespace
}  // namespace cortex::test
