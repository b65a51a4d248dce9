// SPDX-License-Identifier: Apache-2.0
#include "conform/conform.hpp"

#include "conform/tests.hpp"

#include <algorithm>
#include <chrono>
#include <exception>

namespace cortex::cli::conform {
namespace {

const Tests& allTests() {
    static const Tests all = [] {
        Tests tests;
        for (Tests each : {deviceTests(), fieldbusTests(), ds402Tests(), axisTests(),
                           gripperTests(), honestyTests()}) {
            std::ranges::move(each, std::back_inserter(tests));
        }
        return tests;
    }();
    return all;
}

bool isFor(const Test& test, const Plant& plant) {
    if (test.per == Per::Axis && !plant.hasAxes()) return false;
    if (test.needs == Needs::Grip && !plant.isGripper()) return false;
    return std::ranges::any_of(test.types,
                               [&](const std::string& type) { return plant.deviceIs(type); });
}

// Why it is not to run; "": nothing speaks against it.
std::string notWished(const Test& test, const Plant& plant, const Wishes& wishes) {
    if (test.needs == Needs::Nothing) return {};
    if (test.needs == Needs::Grip) {
        return wishes.grip ? ""
                           : "it opens and closes the jaws wholly; --grip WIDTH allows that, with "
                             "the width in m of what is between them, or 0";
    }
    if (!wishes.move) {
        const DataItem* position = plant.axes.empty()
                                       ? nullptr
                                       : plant.type(plant.axes.front().demand).findData("position");
        const std::string unit = position == nullptr ? "" : ", in " + position->unit;
        return "it moves the axis or gives it torque; --move AMPLITUDE allows that" + unit;
    }
    if (test.needs == Needs::Homing && !wishes.home)
        return "it moves the axis as far as its switches; --home allows that";
    return {};
}

Judgement judge(Bench& bench, const Test& test, std::size_t place) {
    if (std::string why = notWished(test, bench.plant(), bench.wishes()); !why.empty())
        return skipped(std::move(why));
    try {
        return test.run(bench, place);
    } catch (const Ended& ended) {
        return ended.judgement;
    } catch (
        const std::exception& error) {  // no cycle came, or its types are not as they should be
        return failed(error.what());
    }
}

Result run(Bench& bench, const Test& test, std::size_t place, bool several) {
    const auto begin = std::chrono::steady_clock::now();
    Result result{test.name, test.needs != Needs::Nothing, judge(bench, test, place), 0};
    if (several) result.test += ", axis " + std::to_string(place + 1);
    if (const std::string left = bench.putBack(); !left.empty()) {
        const std::string& text = result.judgement.text;
        result.judgement = failed(text + (text.empty() ? "" : "; ") + left);
    }
    result.seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    return result;
}

}  // namespace

DeviceResults testDevice(Live& live, const Plant& plant, const Wishes& wishes,
                         const std::function<void(const Result&)>& each) {
    DeviceResults all{plant.path(plant.device), plant.deviceType().name, plant.agent, {}};
    Bench bench{live, plant, wishes};
    for (const Test& test : allTests()) {
        if (!isFor(test, plant)) continue;
        const std::size_t axes = std::max<std::size_t>(plant.axes.size(), 1);
        const std::size_t count = test.per == Per::Axis ? axes : 1;
        for (std::size_t place = 0; place < count; ++place) {
            all.results.push_back(run(bench, test, place, count > 1));
            each(all.results.back());
        }
    }
    return all;
}

}  // namespace cortex::cli::conform
