// SPDX-License-Identifier: Apache-2.0
#include "conform/conform.hpp"
#include "conform/junit.hpp"
#include "live/saved_file.hpp"
#include "text/interrupts.hpp"
#include "text/new_files.hpp"
#include "text/text_table.hpp"
#include "verbs/live_verbs.hpp"

#include <algorithm>
#include <chrono>
#include <iostream>
#include <map>
#include <string>

namespace cortex::cli {
namespace {

using conform::DeviceResults;
using conform::Verdict;

Look lookOf(Verdict verdict) {
    if (verdict == Verdict::Passed) return Look::Good;
    return verdict == Verdict::Failed ? Look::Error : Look::Faint;
}

// With a blank at least behind it.
std::string padded(const std::string& text, std::size_t width) {
    return text + std::string(text.size() < width ? width - text.size() : 1, ' ');
}

// The results of one device, each as it comes: some tests take a minute.
class ResultPrinter {
public:
    explicit ResultPrinter(bool colours) : colours_{colours} {}

    void print(const conform::Result& result) {
        constexpr std::size_t verdictWidth = 9, testWidth = 36;
        const Verdict verdict = result.judgement.verdict;
        const TextLine line{{padded(name(verdict), verdictWidth), lookOf(verdict)},
                            {padded(result.test, testWidth)},
                            {shortened(result)}};
        std::string text = rendered(line, anyWidth, colours_);
        text.erase(text.find_last_not_of(' ') + 1);
        std::cout << text << std::endl;
    }

private:
    // Why tests are skipped is said once.
    std::string shortened(const conform::Result& result) {
        const std::string& text = result.judgement.text;
        if (result.judgement.verdict != Verdict::Skipped) return text;
        const auto [said, isNew] = said_.emplace(text, result.test);
        return isNew ? text : "as for '" + said->second + "'";
    }

    bool colours_;
    std::map<std::string, std::string> said_;  // the first test that was skipped for it
};

std::size_t total(const std::vector<DeviceResults>& devices, Verdict verdict) {
    std::size_t all = 0;
    for (const DeviceResults& each : devices) all += conform::count(each, verdict);
    return all;
}

// It has tests that move it, and none of them was run.
bool stoodStill(const DeviceResults& device) {
    bool mayMove = false, moved = false;
    for (const conform::Result& each : device.results) {
        mayMove = mayMove || each.moves;
        moved = moved || (each.moves && each.judgement.verdict != Verdict::Skipped);
    }
    return mayMove && !moved;
}

Json resultJson(const conform::Result& result) {
    return {{"test", result.test},
            {"moves", result.moves},
            {"verdict", name(result.judgement.verdict)},
            {"text", result.judgement.text},
            {"seconds", result.seconds}};
}

Json allJson(const std::vector<DeviceResults>& devices) {
    Json list = Json::array();
    for (const DeviceResults& each : devices) {
        Json results = Json::array();
        for (const conform::Result& result : each.results) results.push_back(resultJson(result));
        list.push_back({{"path", each.path},
                        {"type", each.type},
                        {"agent", each.agent},
                        {"results", results}});
    }
    return {{"devices", list},
            {"passed", total(devices, Verdict::Passed)},
            {"failed", total(devices, Verdict::Failed)},
            {"skipped", total(devices, Verdict::Skipped)}};
}

std::int64_t utcNow() {
    const auto since = std::chrono::system_clock::now().time_since_epoch();
    return std::chrono::duration_cast<std::chrono::nanoseconds>(since).count();
}

}  // namespace

// All are looked for before the first is tested. An interrupt puts back what was changed.
Exit testConformance(const ConformOptions& options) {
    if (!options.junit.empty()) checkFolder(options.junit);
    if (!options.junit.empty() && !options.force) refuseExisting(options.junit);
    const Interrupts interrupts;
    Live live{options.network};
    live.actFor(options.person);
    std::vector<conform::Plant> plants;
    for (const std::string& each : options.paths) plants.push_back(conform::findPlant(live, each));
    const std::int64_t began = utcNow();
    const bool colours = coloured(Stream::Output);
    const conform::Wishes wishes{.move = options.move,
                                 .grip = options.grip,
                                 .speed = options.speed,
                                 .home = options.home,
                                 .take = options.take,
                                 .seconds = options.seconds};
    std::vector<DeviceResults> devices;
    for (const conform::Plant& each : plants) {
        if (!options.json) {
            std::cout << (devices.empty() ? "" : "\n") << each.path(each.device) << " ("
                      << each.deviceType().name << " of " << printable(each.agent) << ")"
                      << std::endl;
        }
        ResultPrinter printer{colours};
        devices.push_back(
            conform::testDevice(live, each, wishes, [&](const conform::Result& result) {
                if (!options.json) printer.print(result);
            }));
    }
    if (!options.junit.empty()) writeSaved(options.junit, conform::junitText(devices, began));
    if (options.json) {
        print(allJson(devices));
    } else {
        std::cout << '\n'
                  << total(devices, Verdict::Passed) << " passed, "
                  << total(devices, Verdict::Failed) << " failed, "
                  << total(devices, Verdict::Skipped) << " skipped\n";
    }
    Exit exit = total(devices, Verdict::Failed) == 0 ? Yes : No;
    for (const DeviceResults& each : devices) {
        if (!(options.move || options.grip) || !stoodStill(each)) continue;
        std::cerr << "cortex: nothing of " << each.path
                  << " was moved, although that was asked for: see why its tests were skipped\n";
        exit = No;
    }
    return exit;
}

}  // namespace cortex::cli
