// SPDX-License-Identifier: Apache-2.0
#include "profiler/report_results.hpp"
#include "report/machine_facts.hpp"
#include "report/number_text.hpp"
#include "report/quantity_text.hpp"
#include "report/summary_text.hpp"
#include "text/plain_text.hpp"

#include <limits>
#include <sstream>

#include <unistd.h>

#include <gtest/gtest.h>

namespace cortex::profiler {
namespace {

namespace fs = std::filesystem;

std::string valueOf(const fs::path& root, const std::string& fact) {
    for (const auto& [name, value] : machineFacts(root)) {
        if (name == fact) return value;
    }
    return "no such fact";
}

TEST(ReportSummary, IsAnAlignedTableUnderHeadings) {
    Results results = sampleResults();
    results.quantities[0].group = results.quantities[1].group = "Group";
    EXPECT_EQ(summaryText(results, 100),
              "what        here       beside it  ratio       aim          paper\n"
              "\nGroup:\n"
              "first   0.333 ns  bare: 0.667 ns   0.5×  ≤ 0.5 ns  met     Fig. 1\n"
              "second    41 234                         ≥ 50 000  MISSED\n"
              "\nAims met: 1 of 2\n"
              "\nMissed:\n- second: 41 234 (aim ≥ 50 000)\n"
              "\n- first note\n- second \"note\", with a comma\n");
}

TEST(ReportSummary, AMissedAimIsAnExitCodeAndANotJudgedOneIsNot) {
    Results results = sampleResults();
    EXPECT_EQ(exitCodeOf(results), 4);

    results.quantities[1].doubt = "too noisy";
    EXPECT_EQ(exitCodeOf(results), 0);

    results.complete = false;
    EXPECT_EQ(exitCodeOf(results), 1);
}

TEST(ReportSummary, WhatIsNotJudgedIsNeitherMetNorMissed) {
    Results results = sampleResults();
    results.quantities[1].doubt = "too noisy";

    const std::string text = summaryText(results, 100);

    EXPECT_TRUE(aimsOf(results).missed.empty());
    EXPECT_NE(text.find("Aims met: 1 of 2"), std::string::npos);
    EXPECT_NE(text.find("Not judged, run it again:\n- second: 41 234: too noisy"),
              std::string::npos)
        << text;
}

TEST(ReportSummary, FitsTheWidthAndKeepsTheVerdict) {
    Results results = sampleResults();
    results.quantities[1].what = "a long description of what was measured, with many words in it";

    const std::string text = summaryText(results, 60);

    std::istringstream lines{text};
    for (std::string line; std::getline(lines, line);) EXPECT_LE(cli::textWidth(line), 60U) << line;
    EXPECT_NE(text.find("MISSED"), std::string::npos);
    EXPECT_NE(text.find("words in it"), std::string::npos);
    EXPECT_EQ(text.find("Fig. 1"), std::string::npos);
}

TEST(ReportSummary, DoesNotObeyControlCharacters) {
    Results results = sampleResults();
    results.quantities[0].what = "a\033[2Jb";
    results.notes = {"c\033[2Jd"};

    EXPECT_EQ(summaryText(results, 80).find('\033'), std::string::npos);
}

TEST(ReportSummary, SaysWhenNothingOrNotAllWasMeasured) {
    const std::string text = summaryText({}, 80);

    EXPECT_NE(text.find("Nothing was measured"), std::string::npos);
    EXPECT_NE(text.find("Not complete"), std::string::npos);
}

TEST(ReportSummary, WhatIsNotANumberMissesAnyAim) {
    Quantity quantity;
    quantity.value = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(verdictOf(quantity), std::nullopt);

    for (const Aim aim : {Aim::AtMost, Aim::AtLeast}) {
        quantity.aim = aim;
        EXPECT_EQ(verdictOf(quantity), Verdict::Missed);
    }
    quantity.value = quantity.limit = 3;
    EXPECT_EQ(verdictOf(quantity), Verdict::Met);
}

TEST(ReportSummary, ThereIsNoRatioToNothing) {
    Quantity quantity;
    quantity.value = 4;
    EXPECT_EQ(ratioToBaseline(quantity), std::nullopt);
    quantity.baseline = 0;
    EXPECT_EQ(ratioToBaseline(quantity), std::nullopt);
    quantity.baseline = 8;
    EXPECT_EQ(ratioToBaseline(quantity), 0.5);
}

TEST(ReportMachineFacts, AreReadFromTheSystem) {
    const Folder root;
    const fs::path cpus = root.path() / "sys/devices/system/cpu";
    for (const char* folder :
         {"cpu0/cache/index0", "cpu0/cache/index2", "cpu0/cpufreq", "cpu1/cpufreq"}) {
        fs::create_directories(cpus / folder);
    }
    fs::create_directories(root.path() / "proc/sys/kernel");
    fs::create_directories(root.path() / "sys/kernel");
    fs::create_directories(root.path() / "dev");
    root.write("proc/cpuinfo",
               "processor\t: 0\nmodel name\t: A 9000\nflags\t\t: fpu hypervisor sse\n");
    root.write("proc/loadavg", "0.33 0.42 3.20 1/200 4711\n");
    root.write("proc/sys/kernel/sched_rt_runtime_us", "950000\n");
    root.write("proc/sys/kernel/sched_rt_period_us", "1000000\n");
    root.write("sys/kernel/realtime", "1\n");
    const std::string cpu = "sys/devices/system/cpu/";
    root.write(cpu + "isolated", "2-3\n");
    root.write(cpu + "cpu0/cpufreq/scaling_governor", "powersave\n");
    root.write(cpu + "cpu1/cpufreq/scaling_governor", "performance\n");
    root.write("dev/cpu_dma_latency", std::string(4, '\0'));
    root.write(cpu + "cpu0/cache/index0/level", "1\n");
    root.write(cpu + "cpu0/cache/index0/type", "Data\n");
    root.write(cpu + "cpu0/cache/index0/size", "32K\n");
    root.write(cpu + "cpu0/cache/index2/level", "2\n");
    root.write(cpu + "cpu0/cache/index2/type", "Unified\n");
    root.write(cpu + "cpu0/cache/index2/size", "1024K\n");

    EXPECT_EQ(valueOf(root.path(), "CPU"), "A 9000");
    EXPECT_EQ(valueOf(root.path(), "virtualised"), "yes");
    EXPECT_EQ(valueOf(root.path(), "caches"), "L1d 32K, L2 1024K");
    EXPECT_EQ(valueOf(root.path(), "governor"), "performance, powersave");
    EXPECT_EQ(valueOf(root.path(), "idle CPUs"), "do not sleep");
    EXPECT_EQ(valueOf(root.path(), "isolated CPUs"), "2-3");
    EXPECT_EQ(valueOf(root.path(), "preemption"), "PREEMPT_RT");
    EXPECT_EQ(valueOf(root.path(), "throttling"),
              "real-time threads have 950000 of each 1000000 us");
    EXPECT_EQ(valueOf(root.path(), loadFact), "0.33 0.42 3.20");
}

TEST(ReportMachineFacts, SayWhatTheSystemDoesNotTell) {
    const Folder empty;

    for (const auto& [fact, value] : machineFacts(empty.path())) EXPECT_NE(value, "") << fact;
    EXPECT_EQ(valueOf(empty.path(), "clock source"), "unknown");
}

TEST(ReportMachineFacts, NameNoHostNorPath) {
    char host[256] = {};
    gethostname(host, sizeof host - 1);

    for (const auto& [fact, value] : machineFacts()) {
        EXPECT_EQ(value.find('/'), std::string::npos) << fact;
        std::istringstream words{value};
        for (std::string word; words >> word;) EXPECT_NE(word, host) << fact;
    }
}

}  // namespace
}  // namespace cortex::profiler
