// SPDX-License-Identifier: Apache-2.0
// The page of findings against the sources, where a rule is named as a literal.
#include "core/model_folder.hpp"

#include <array>
#include <filesystem>
#include <regex>
#include <set>
#include <string>

#include <gtest/gtest.h>

namespace cortex::test {
namespace {

// The rules that a source gives to a report: the second argument of error() and warning(), and
// what restore finds wrong.
std::set<std::string> rulesIn(const std::string& text) {
    static const std::array patterns{
        std::regex{R"re((?:error|warning)\(\s*[^,;]*,\s*"([a-z]+(?:-[a-z]+)*)",)re"},
        std::regex{R"re(wrong\("([a-z]+(?:-[a-z]+)*)",)re"},
        std::regex{R"re(wrong\([^;"]*\? "([a-z-]+)" : )re"},
        std::regex{R"re(wrong\([^;"]*\? "[a-z-]+" : "([a-z-]+)")re"}};
    const auto here = std::regex_constants::match_continuous;
    std::set<std::string> rules;
    for (const std::string call : {"error(", "warning(", "wrong("}) {
        for (auto at = text.find(call); at != std::string::npos; at = text.find(call, at + 1)) {
            const auto begin = text.begin() + static_cast<std::ptrdiff_t>(at);
            for (const std::regex& pattern : patterns) {
                std::smatch found;
                if (std::regex_search(begin, text.end(), found, pattern, here))
                    rules.insert(found[1]);
            }
        }
    }
    return rules;
}

TEST(FindingsPage, ExplainsEveryRuleThatASourceNames) {
    const std::string page = textOf(CORTEX_SOURCE_DIR "/docs/findings.md");
    std::set<std::string> rules;
    for (const char* layer : {"core", "cs", "comms", "toolkit", "explorer"}) {
        const std::string folder = std::string{CORTEX_SOURCE_DIR "/"} + layer;
        for (const auto& file : std::filesystem::recursive_directory_iterator{folder}) {
            if (file.path().extension() != ".cpp") continue;
            for (const std::string& each : rulesIn(textOf(file.path()))) {
                rules.insert(each);
                EXPECT_TRUE(contains(page, "\n| `" + each + "` |")) << file.path() << ": " << each;
            }
        }
    }
    for (const char* known : {"link-type", "no-system", "not-settable", "type-differs"}) {
        EXPECT_EQ(rules.count(known), 1U) << known;
    }
}

}  // namespace
}  // namespace cortex::test
