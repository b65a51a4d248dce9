// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/type_description.hpp"

#include "support/share.hpp"

#include <cstddef>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace cortex {
namespace {

using test::share;

// Changes one text at a random place.
class Mutator {
public:
    explicit Mutator(unsigned seed) : random_{seed} {}

    void mutate(TypeDescription& type) {
        std::vector<std::vector<DescribedAttribute>*> lists{&type.attributes};
        std::vector<std::string*> names{&type.name, &type.description};
        const auto item = [&](DescribedItem& each) {
            lists.push_back(&each.attributes);
            names.push_back(&each.name);
        };
        for (std::string& each : type.parents) names.push_back(&each);
        for (DescribedItem& each : type.data) item(each);
        for (DescribedCommand& each : type.commands) {
            lists.push_back(&each.attributes);
            names.push_back(&each.name);
            for (DescribedItem& parameter : each.request) item(parameter);
            for (DescribedItem& parameter : each.response) item(parameter);
        }
        for (DescribedRule& each : type.rules) {
            lists.push_back(&each.attributes);
            names.push_back(&each.name);
        }
        if (below(10) == 0) return change(*names[below(names.size())]);
        std::vector<DescribedAttribute>& list = *lists[below(lists.size())];
        if (list.empty() || below(20) == 0) {
            list.push_back({some({"min", "default", "labels", "create", "long", "colour"}),
                            some({"", "1", "hold", "0:A 0:A", "Base", "true"})});
        } else if (below(20) == 0) {
            list.erase(list.begin() + static_cast<std::ptrdiff_t>(below(list.size())));
        } else {
            DescribedAttribute& attribute = list[below(list.size())];
            change(below(10) == 0 ? attribute.name : attribute.text);
        }
    }
    std::size_t below(std::size_t end) { return random_() % end; }

private:
    std::string some(const std::vector<std::string>& texts) { return texts[below(texts.size())]; }

    void change(std::string& text) {
        static const std::vector<std::string> odd{
            "",       " ",     "-",  "0",  "-1",    "1e999", "nan",  "99999999999999999999",
            "*",      "true",  "\"", "\\", "a b",   "0:",    ":x",   "\xff",
            "always", "hold",  "\n", ".",  "Fault", "Base",  "4096", "65537",
            "1e-300", "float", "+1"};
        const std::size_t at = below(text.size() + 1);
        switch (below(5)) {
            case 0:
                text = some(odd);
                break;
            case 1:
                text.insert(at, some(odd));
                break;
            case 2:
                text.erase(at, 1 + below(3));
                break;
            case 3:
                if (at < text.size()) text[at] = static_cast<char>(below(256));
                break;
            default:
                text += text;
        }
    }

    std::mt19937 random_;
};

struct Mutated {
    const char* file;
    unsigned mutations;
};

class MutatedDescriptions : public testing::TestWithParam<Mutated> {};

TEST_P(MutatedDescriptions, AreRefusedOrMeanTheSame) {
    const TypeModel model =
        TypeModel::load(std::filesystem::path{CORTEX_SOURCE_DIR} / GetParam().file);
    std::vector<TypeDescription> sound;
    for (const auto& [name, type] : model.types()) sound.push_back(describe(type));
    const unsigned mutations = share(GetParam().mutations);
    unsigned refused = 0, same = 0;
    for (unsigned seed = 0; seed < mutations; ++seed) {
        SCOPED_TRACE(seed);
        Mutator mutator{seed};
        std::vector<TypeDescription> described = sound;
        mutator.mutate(described[mutator.below(described.size())]);
        Report report;
        const TypeModel told = modelOf(described, report);
        for (const auto& [name, type] : told.types()) {
            ASSERT_NE(model.find(name), nullptr) << name;
            ASSERT_EQ(canonicalText(type), canonicalText(model.at(name)));
        }
        const bool whole = told.types().size() == model.types().size();
        ASSERT_EQ(whole, report.ok()) << report.text();
        ++(whole ? same : refused);
    }
    RecordProperty("same", std::to_string(same));
    EXPECT_GT(refused, mutations / 2);
    EXPECT_GT(same, 0U);
}

INSTANTIATE_TEST_SUITE_P(Files, MutatedDescriptions,
                         testing::Values(Mutated{"tests/data/schema/valid/morphology.xml", 1500},
                                         Mutated{"tests/data/cs-rules.xml", 100}));

}  // namespace
}  // namespace cortex
