// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/error.hpp"

#include "profiler/report_results.hpp"
#include "report/results_files.hpp"
#include "report/results_json.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace cortex::profiler {
namespace {

namespace fs = std::filesystem;

std::string errorOf(const Folder& folder) {
    try {
        load(folder.path());
    } catch (const Error& error) {
        return error.what();
    }
    return {};
}

std::string replaced(std::string text, const std::string& part, const std::string& by) {
    const std::size_t at = text.find(part);
    EXPECT_NE(at, std::string::npos) << part;
    return text.replace(at, part.size(), by);
}

TEST(ReportFiles, WhatIsLoadedIsWhatWasSaved) {
    const Folder folder;
    const Results saved = sampleResults();

    save(saved, folder.path() / "deep" / "er");
    const Results loaded = load(folder.path() / "deep" / "er");

    EXPECT_EQ(jsonText(loaded), jsonText(saved));
    EXPECT_EQ(loaded.machine, saved.machine);
    EXPECT_EQ(loaded.notes, saved.notes);
    EXPECT_TRUE(loaded.complete);
    ASSERT_EQ(loaded.quantities.size(), 2U);
    EXPECT_EQ(loaded.quantities[0].value, 1.0 / 3);
    EXPECT_EQ(loaded.quantities[0].repeats, saved.quantities[0].repeats);
    EXPECT_EQ(loaded.quantities[0].baseline, 2.0 / 3);
    EXPECT_TRUE(std::isnan(loaded.quantities[1].baseline));
    EXPECT_EQ(loaded.quantities[1].aim, Aim::AtLeast);
    EXPECT_FALSE(loaded.quantities[1].lessIsBetter);
    ASSERT_EQ(loaded.figures.size(), 1U);
    EXPECT_TRUE(loaded.figures[0].x.logarithmic);
    EXPECT_EQ(loaded.figures[0].series[0].points[2].y, 3e-300);
    EXPECT_TRUE(loaded.figures[0].series[1].baseline);
    EXPECT_EQ(loaded.figures[0].marks[0].along, Mark::Along::X);
    EXPECT_EQ(loaded.figures[0].marks[1].text, "limit");
}

TEST(ReportFiles, WhatIsNotANumberComesBackAsThat) {
    const Folder folder;
    Results results = sampleResults();
    results.quantities[0].value = std::numeric_limits<double>::quiet_NaN();
    results.quantities[0].baseline = std::numeric_limits<double>::infinity();
    results.figures[0].series[0].points[1].y = -std::numeric_limits<double>::infinity();

    save(results, folder.path());
    const Results loaded = load(folder.path());

    EXPECT_TRUE(std::isnan(loaded.quantities[0].value));
    EXPECT_TRUE(std::isnan(loaded.quantities[0].baseline));
    EXPECT_TRUE(std::isnan(loaded.figures[0].series[0].points[1].y));
    EXPECT_EQ(loaded.figures[0].series[0].points[1].x, 10);
}

TEST(ReportFiles, TextsThatAreNotUtf8AreSavedAllTheSame) {
    const Folder folder;
    Results results = sampleResults();
    results.notes = {"broken \xC3\x28 text"};

    save(results, folder.path());

    EXPECT_EQ(load(folder.path()).notes.size(), 1U);
}

TEST(ReportFiles, SavingAgainReplacesAndLeavesNothingBehind) {
    const Folder folder;
    Results results = sampleResults();
    results.complete = false;
    save(results, folder.path());

    results.complete = true;
    results.notes.clear();
    save(results, folder.path());

    EXPECT_TRUE(load(folder.path()).complete);
    EXPECT_TRUE(load(folder.path()).notes.empty());
    std::vector<std::string> files;
    for (const auto& each : fs::directory_iterator{folder.path()}) {
        files.push_back(each.path().filename());
    }
    std::ranges::sort(files);
    std::erase(files, "fig1-first.svg");  // only where there is gnuplot
    EXPECT_EQ(files, (std::vector<std::string>{"fig1-first.csv", "report.html", "results.json",
                                               "summary.csv"}));
}

TEST(ReportFiles, FiguresAreTablesWithUnitsAndAllDigits) {
    EXPECT_EQ(figureCsv(sampleResults().figures[0]),
              "series,simplexes,duty cycle (%)\n"
              "p99,1,0.1\n"
              "p99,10,0.14285714285714285\n"
              "p99,100,3e-300\n"
              "\"bare, \"\"idle\"\"\",1,2\n");
}

TEST(ReportFiles, TheSummaryHasARowForEachQuantity) {
    EXPECT_EQ(
        summaryCsv(sampleResults()),
        "id,what,unit,value,repeats,baseline,baseline name,ratio,aim,limit,verdict,paper\n"
        "a/1,first,ns,0.3333333333333333,2,0.6666666666666666,bare,0.5,at most,0.5,met,Fig. 1\n"
        "a/2,second,,41234,0,,,,at least,50000,MISSED,\n");
}

TEST(ReportFiles, NamesOfFilesStayInTheFolderAndApart) {
    Results results;
    for (const char* id : {"../../etc/x", "same", "same", "summary", "", ".hidden", "ä b"}) {
        results.figures.emplace_back().id = id;
    }

    const std::vector<std::string> names = figureFiles(results);

    EXPECT_EQ(names, (std::vector<std::string>{"figure..-..-etc-x", "same", "same-2", "summary-2",
                                               "figure", "figure.hidden", "---b"}));
}

TEST(ReportFiles, AFolderThatCannotBeMadeIsNamed) {
    const Folder folder;
    folder.write("file", "");

    try {
        save(sampleResults(), folder.path() / "file");
        FAIL() << "saved into a file";
    } catch (const Error& error) {
        EXPECT_NE(std::string{error.what()}.find("file'"), std::string::npos) << error.what();
    }
}

TEST(ReportFiles, AFolderWithoutResultsIsRefusedWithARemedy) {
    const Folder folder;

    const std::string error = errorOf(folder);

    EXPECT_NE(error.find("results.json"), std::string::npos) << error;
    EXPECT_NE(error.find("name the folder"), std::string::npos) << error;
}

TEST(ReportFiles, AFolderInPlaceOfTheFileIsRefused) {
    const Folder folder;
    fs::create_directory(folder.path() / "results.json");

    EXPECT_NE(errorOf(folder), "");
}

TEST(ReportFiles, EveryTruncatedFileIsRefused) {
    const std::string whole = jsonText(sampleResults());

    for (std::size_t length = 0; length + 1 < whole.size(); ++length) {
        ASSERT_THROW(resultsOf(whole.substr(0, length)), Error) << length;
    }
    const Folder folder;
    folder.write("results.json", whole.substr(0, whole.size() / 2));
    EXPECT_NE(errorOf(folder).find("not whole"), std::string::npos);
}

TEST(ReportFiles, AnyWrongOctetIsReadOrRefused) {
    const std::string whole = jsonText(sampleResults());

    std::size_t refused = 0;
    for (std::size_t at = 0; at < whole.size(); ++at) {
        for (const char wrong : {'\0', '"', '9', '[', '\xFF'}) {
            std::string text = whole;
            text[at] = wrong;
            try {
                resultsOf(text);
            } catch (const Error&) {
                ++refused;
            }
        }
    }
    EXPECT_GT(refused, whole.size());
}

TEST(ReportFiles, WhatIsWrongIsSaidWithItsPlace) {
    const Folder folder;
    const std::string whole = jsonText(sampleResults());
    const auto refusal = [&](const std::string& part, const std::string& by) {
        folder.write("results.json", replaced(whole, part, by));
        return errorOf(folder);
    };
    const auto says = [](const std::string& error, const std::string& what) {
        return error.find(what) != std::string::npos && error.find("results.json") < error.size();
    };

    EXPECT_PRED2(says, refusal("cortex-profiler-results", "other"), "not written by");
    EXPECT_PRED2(says, refusal("\"formatVersion\":2", "\"formatVersion\":1"), "another version");
    EXPECT_PRED2(says, refusal("\"a/2\"", "7"), "(/quantities/1/id) type must be string");
    EXPECT_PRED2(says, refusal("\"at least\"", "\"exactly\""), "must be one of 'none'");
    EXPECT_PRED2(says, refusal("\"limit\":0.5", "\"border\":0.5"), "(/quantities/0) key 'limit'");
    EXPECT_PRED2(says, refusal("\"y\":0.1", "\"y\":\"0.1\""), "(/figures/0/series/0/points/0/y)");
    EXPECT_PRED2(says, refusal("\"marks\":[", "\"marks\":[null,"), "(/figures/0/marks/0)");
    EXPECT_PRED2(says, refusal("\"complete\":true", "\"complete\":1"), "(/complete)");
}

TEST(ReportFiles, ForeignJsonIsRefused) {
    const Folder folder;
    const std::string deep(200000, '[');
    for (const std::string& text :
         {std::string{"null"}, std::string{"[]"}, std::string{"{}"}, std::string{"1e999"},
          std::string{"\"text\""}, std::string{R"({"format":{}})"}, deep,
          deep + std::string(200000, ']')}) {
        folder.write("results.json", text);
        EXPECT_NE(errorOf(folder), "") << text.substr(0, 20);
    }
}

}  // namespace
}  // namespace cortex::profiler
