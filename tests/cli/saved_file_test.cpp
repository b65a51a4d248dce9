// SPDX-License-Identifier: Apache-2.0
// What `save` writes of any value, `restore` takes.
#include "live/saved_file.hpp"

#include "cortex/core/labelled_value.hpp"
#include "cortex/core/model_files.hpp"
#include "cortex/core/record.hpp"

#include "core/model_folder.hpp"
#include "live/judged_value.hpp"
#include "texts/random_model.hpp"

#include <array>
#include <limits>
#include <map>
#include <string>

#include <gtest/gtest.h>

namespace cortex::cli {
namespace {

using test::Chance;

// One that no range and no label knows, often.
Value anyValue(Chance& chance, const DataItem& item) {
    if (!chance.oneIn(3)) return test::randomValue(chance, item);
    DataItem free = item;
    free.min.reset();
    free.max.reset();
    free.labels.clear();
    Value value = test::randomValue(chance, free);
    constexpr std::array strange{std::numeric_limits<double>::infinity(),
                                 -std::numeric_limits<double>::infinity(),
                                 std::numeric_limits<double>::quiet_NaN()};
    if (auto* numbers = std::get_if<std::vector<double>>(&value))
        numbers->at(chance.below(numbers->size())) = chance.oneOf(strange);
    if (auto* texts = std::get_if<std::vector<std::string>>(&value)) {
        std::string& text = texts->at(chance.below(texts->size()));
        if (!text.empty()) text.back() = '\xff';  // no UTF-8
    }
    return value;
}

TEST(SavedFile, HasOnlyWhatCanBeSetAgainBitByBit) {
    Chance chance{7};
    const test::ModelFolder folder;
    std::size_t kept = 0, left = 0;
    for (int model = 0; model < 5; ++model) {
        const test::RandomModel random{chance, 2, 1};
        const std::array files{
            folder.write("types.xml",
                         "<ontology name='t' version='1.0'><include file='base.xml'/>"
                         "<type name='Carrier' extends='Active'/>\n" +
                             random.ontology() + "</ontology>")};
        Report report;
        const ModelFiles read = readModelFiles(files, report);
        ASSERT_TRUE(report.ok()) << report.text();
        for (int file = 0; file < 40; ++file) {
            std::vector<SavedSimplex> simplexes;
            std::map<std::string, Value> good;
            for (const auto& [name, type] : read.types.types()) {
                const CommandTable table = commandTable(type);
                SavedSimplex& simplex = simplexes.emplace_back("/" + name, name);
                for (const DataItem* item : table.settable) {
                    const Value value = anyValue(chance, *item);
                    std::string wrong = judgedValue(table, *item, toText(value)).why;
                    wrong.empty() ? ++kept : ++left;
                    if (wrong.empty()) good.emplace(simplex.path + "." + item->name, value);
                    simplex.items.push_back({item->name, toText(value), "", std::move(wrong), {}});
                }
            }
            const auto saved = folder.write("saved.xml", savedText(simplexes, "A title"));
            for (const SavedSimplex& simplex : readSaved(saved)) {
                const Type& type = *read.types.find(simplex.type);
                const CommandTable table = commandTable(type);
                for (const SavedItem& item : simplex.items) {
                    const JudgedValue back =
                        judgedValue(table, *type.findData(item.name), item.value);
                    ASSERT_EQ(back.why, "") << simplex.path << '.' << item.name;
                    ASSERT_EQ(valueError(*type.findData(item.name), back.value), "")
                        << "an agent that starts with it judges it so";
                    const auto wanted = good.extract(simplex.path + "." + item.name);
                    ASSERT_TRUE(wanted) << simplex.path << '.' << item.name;
                    ASSERT_EQ(test::difference(wanted.mapped(), back.value), "");
                }
            }
            ASSERT_TRUE(good.empty()) << good.begin()->first << " is not in the file";
        }
    }
    EXPECT_GT(kept, left);
    EXPECT_GT(left, 200U);
}

}  // namespace
}  // namespace cortex::cli
