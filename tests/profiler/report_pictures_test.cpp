// SPDX-License-Identifier: Apache-2.0
#include "profiler/report_results.hpp"
#include "report/html_report.hpp"
#include "report/number_text.hpp"
#include "report/pictures.hpp"
#include "report/results_files.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <gtest/gtest.h>

namespace cortex::profiler {
namespace {

bool hasGnuplot() { return std::system("command -v gnuplot >/dev/null") == 0; }

// Without the programs of the system for as long as it lives.
class NoPrograms {
public:
    NoPrograms() : before_{std::getenv("PATH")} { setenv("PATH", "/nowhere", 1); }
    ~NoPrograms() { setenv("PATH", before_.c_str(), 1); }
    NoPrograms(const NoPrograms&) = delete;
    NoPrograms& operator=(const NoPrograms&) = delete;

private:
    std::string before_;
};

TEST(ReportTicks, EveryAxisHasAtLeastTwoNumbers) {
    for (const bool logarithmic : {false, true}) {
        for (const std::vector<double>& values : {std::vector{1.0},
                                                  {7.5},
                                                  {0.001, 0.0011},
                                                  {3, 4},
                                                  {1, 9},
                                                  {95, 105},
                                                  {1e-5, 1},
                                                  {1, 1e6},
                                                  {1234.5, 1234.6},
                                                  {1e9, 3e9}}) {
            const Ticks ticks = ticksOf(values, logarithmic);
            EXPECT_GE(ticks.at.size(), 2U) << values[0] << (logarithmic ? " logarithmic" : "");
            EXPECT_LE(ticks.at.size(), 16U) << values[0] << (logarithmic ? " logarithmic" : "");
            for (const double each : values) {
                EXPECT_LE(ticks.low, each);
                EXPECT_GE(ticks.high, each);
            }
        }
    }
}

TEST(ReportTicks, CountsHaveWholeNumbers) {
    for (const bool logarithmic : {false, true}) {
        for (const std::vector<double>& counts :
             {std::vector{1.0, 2.0}, {1, 2, 4}, {3}, {1, 16}, {64, 16384}}) {
            for (const double each : ticksOf(counts, logarithmic).at) {
                EXPECT_EQ(each, std::round(each)) << counts.front() << ' ' << counts.back();
            }
        }
    }
}

TEST(ReportPictures, LinesThatBelongTogetherHaveOneHueAndAllHaveColoursOfTheirOwn) {
    Figure figure;
    for (const char* name : {"same cycle, p50", "same cycle, p99", "same cycle, max",
                             "next cycle, p50", "next cycle, p99", "next cycle, max", "metric"}) {
        figure.series.push_back({name, {{1, 1}, {2, 2}}, false});
    }

    const std::string script = gnuplotScript(figure, "f");

    std::vector<std::string> colours;
    for (std::size_t at = script.find("lw 2 lc rgb '"); at != std::string::npos;
         at = script.find("lw 2 lc rgb '", at + 1)) {
        colours.push_back(script.substr(at + 13, 7));
    }
    std::ranges::sort(colours);
    EXPECT_EQ(colours.size(), 7U);
    EXPECT_EQ(std::ranges::unique(colours).begin(), colours.end());
}

TEST(ReportPictures, TextsOfResultsAreNoCommands) {
    Figure figure = sampleResults().figures[0];
    figure.series[0].name = "a' ; system('touch x') ; b\nset output 'y'";

    const std::string script = gnuplotScript(figure, "f");

    EXPECT_NE(script.find("title 'a'' ; system(''touch x'') ; b\\x0aset output ''y'''"),
              std::string::npos)
        << script;
}

TEST(ReportPictures, AFigureWithoutAValueThatCanBeShownIsNotDrawn) {
    Figure figure = sampleResults().figures[0];
    for (Series& each : figure.series) each.points = {{0, 1}, {-1, 1}, {5, none}};

    EXPECT_EQ(gnuplotScript(figure, "f"), "");
}

TEST(ReportPictures, StandInThePageAndBesideTheTables) {
    if (!hasGnuplot()) GTEST_SKIP() << "gnuplot is not installed (gnuplot-nox)";
    const Folder folder;

    save(sampleResults(), folder.path());

    EXPECT_NE(folder.read("fig1-first.svg").find("idle"), std::string::npos);
    const std::string page = folder.read("report.html");
    EXPECT_EQ(count(page, "<svg"), 1U);
}

TEST(ReportPictures, WithoutGnuplotTheReportSaysSoAndKeepsItsTables) {
    const Folder folder;
    const NoPrograms none;

    save(sampleResults(), folder.path());

    const std::string page = folder.read("report.html");
    EXPECT_EQ(count(page, "<svg"), 0U);
    EXPECT_NE(page.find("apt-get install gnuplot-nox"), std::string::npos);
    EXPECT_NE(page.find("0.333 ns"), std::string::npos);
    EXPECT_NE(page.find("p99,10,0.14285714285714285"), std::string::npos);
}

TEST(ReportHtml, GroupsTheSummaryAndSaysEachVerdict) {
    Results results = sampleResults();
    results.quantities.push_back(results.quantities[0]);
    results.quantities[0].group = "Group <A>";
    results.quantities[1].group = results.quantities[2].group = "Group B";
    results.quantities[2].doubt = "too noisy today";

    const std::string page = htmlReport(results, {""});

    EXPECT_EQ(count(page, "<tr class=\"group\">"), 2U);
    EXPECT_NE(page.find("Group &lt;A&gt;"), std::string::npos);
    EXPECT_NE(page.find(">met<"), std::string::npos);
    EXPECT_NE(page.find(">MISSED<"), std::string::npos);
    EXPECT_NE(page.find(">not judged<"), std::string::npos);
    EXPECT_NE(page.find("too noisy today"), std::string::npos);
    EXPECT_NE(page.find("Aims met: 1 of 3"), std::string::npos);
}

TEST(ReportHtml, NeedsNothingElseAndSaysWhenItIsNotComplete) {
    Results results = sampleResults();
    results.complete = false;
    results.notes = {"<script>alert(1)</script>"};

    const std::string page = htmlReport(results, {""});

    EXPECT_EQ(page.find("<script"), std::string::npos);
    EXPECT_EQ(page.find("http"), std::string::npos);
    EXPECT_NE(page.find("Not complete"), std::string::npos);
    EXPECT_NE(htmlReport({}, {}).find("</html>"), std::string::npos);
}

TEST(ReportNumber, HasOneFormatEverywhere) {
    EXPECT_EQ(readable(0), "0");
    EXPECT_EQ(readable(1000), "1000");
    EXPECT_EQ(readable(41234), "41 234");
    EXPECT_EQ(readable(1234567.8), "1 234 568");
    EXPECT_EQ(readable(0.33333), "0.333");
    EXPECT_EQ(readable(-12.345), "-12.3");
    EXPECT_EQ(readable(1e-5), "1e-5");
    EXPECT_EQ(readable(none), "none");
}

}  // namespace
}  // namespace cortex::profiler
