// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/labelled_value.hpp"
#include "cortex/core/nearest_names.hpp"

#include "live/live_values.hpp"
#include "live/safe_demand.hpp"
#include "text/interrupts.hpp"
#include "verbs/live_verbs.hpp"

#include <algorithm>
#include <functional>
#include <iostream>
#include <map>
#include <set>
#include <thread>

namespace cortex::explorer {
namespace {

// One value that is watched.
struct Watched {
    FoundSimplex simplex;
    const ItemLayout* item = nullptr;
    std::string name;  // "/arm/axis.position"
    std::string itemName;
    std::string shown;  // last, with its quality
};

// What is known of a value in one image of its agent.
struct Reading {
    std::string text;
    Json value, label;  // null: it has none
    std::string wrong;  // how it is out of its range
    Quality quality = Quality::Lost;
    StaleDemand demand{};
};

void addItems(Live& live, const std::string& what, std::vector<Watched>& watched) {
    const std::size_t dot = what.find('.');
    const FoundSimplex simplex = live.find(what.substr(0, dot));
    const std::string& path = simplex.info().path;
    const std::string wanted = dot == std::string::npos ? "" : what.substr(dot + 1);
    std::vector<std::string> names;
    const std::size_t before = watched.size();
    for (const ItemLayout& each : simplex.info().layout->items) {
        names.push_back(each.item->name);
        if (dot != std::string::npos && each.item->name != wanted) continue;
        watched.push_back({simplex, &each, path + "." + each.item->name, each.item->name, ""});
    }
    if (watched.size() > before) return;
    const std::string nearest = nearestNames(wanted, names);
    const std::string all = names.empty() ? "there is none" : "there are " + joined(names);
    throw Failure{NotFound, path + " (" + simplex.type().name + ") has no item '" + wanted + "'; " +
                                (nearest.empty() ? all : nearest)};
}

// A later start of the agent has a structure of its own. Where that has no such item, or has not
// come yet, nothing is read. True: from now on the values are those of another start.
bool follow(Live& live, Watched& watched) {
    const std::string path = watched.name.substr(0, watched.name.find('.'));
    const auto owner = live.ownerOf(path);
    const auto structure = owner ? live.mirror().structure(*owner) : nullptr;
    if (!structure || structure == watched.simplex.structure) return false;
    const std::uint32_t index = structure->find(path);
    const ItemLayout* item =
        index == noSimplex ? nullptr : structure->simplexes[index].layout->find(watched.itemName);
    if (item == nullptr) return false;
    const bool restarted = structure->epoch != watched.simplex.structure->epoch;
    watched.simplex = {*owner, structure, index};
    watched.item = item;
    watched.shown.clear();
    return restarted;
}

Reading read(const Watched& watched, const comms::AgentImage& image) {
    Reading reading;
    const bool same = image && &image->structure() == watched.simplex.structure.get();
    if (!same || !image.came(watched.simplex.index)) return reading;
    reading.quality = image->state(watched.simplex.index).quality;
    reading.demand = safeBecause(watched.simplex, image->state(watched.simplex.index), image);
    const Value value = image->value(watched.simplex.index, *watched.item);
    reading.text = valueText(*watched.item->item, value);
    reading.value = valueJson(*watched.item->item, value);
    reading.label = labelJson(*watched.item->item, value);
    reading.wrong = outsideText(*watched.item->item, value);
    return reading;
}

// Prints what was watched, once for every image.
class ImagePrinter {
public:
    ImagePrinter(const WatchOptions& options, std::vector<Watched>& watched)
        : options_{options}, watched_{watched} {}

    void head() const {
        if (!options_.csv) return;
        std::cout << "time";
        for (const Watched& each : watched_) std::cout << ',' << each.name;
        for (const Watched& each : watched_) std::cout << ',' << each.name << ":quality";
        std::cout << ",restarted" << std::endl;
    }
    // `restarted`: agents whose values are from now on those of another start.
    void line(const std::string& time, const std::vector<Reading>& readings,
              const std::set<std::string>& restarted) {
        if (options_.csv) return csv(time, readings, restarted);
        if (options_.json) return json(time, readings, restarted);
        for (const std::string& each : restarted) {
            std::cout << time << "  values now come from a new start of agent " << printable(each)
                      << '\n';
        }
        for (std::size_t i = 0; i < readings.size(); ++i) text(time, watched_[i], readings[i]);
        std::cout << std::flush;
    }

private:
    static void csv(const std::string& time, const std::vector<Reading>& readings,
                    const std::set<std::string>& restarted) {
        std::cout << time;
        for (const Reading& each : readings) std::cout << ',' << csvText(each.text);
        for (const Reading& each : readings) std::cout << ',' << name(each.quality);
        std::cout << ',' << csvText(joined({restarted.begin(), restarted.end()}, " ")) << std::endl;
    }
    void json(const std::string& time, const std::vector<Reading>& readings,
              const std::set<std::string>& restarted) const {
        Json values = Json::object();
        for (std::size_t i = 0; i < readings.size(); ++i) {
            Json& value = values[watched_[i].name] = {{"value", readings[i].value},
                                                      {"quality", name(readings[i].quality)}};
            if (readings[i].demand.safe) value["safe"] = readings[i].demand.why;
            if (!readings[i].label.is_null()) value["label"] = readings[i].label;
            if (!readings[i].wrong.empty()) value["wrong"] = readings[i].wrong;
        }
        Json line{{"time", time}, {"values", values}};
        if (!restarted.empty()) line["restarted"] = restarted;
        std::cout << line.dump(-1, ' ', false, Json::error_handler_t::replace) << std::endl;
    }
    // Only what has changed.
    static void text(const std::string& time, Watched& watched, const Reading& reading) {
        std::string shown = reading.text;
        if (!watched.item->item->unit.empty()) shown += " " + watched.item->item->unit;
        if (reading.quality != Quality::Good)
            shown += "  " + qualityText(reading.quality, reading.demand);
        if (!reading.wrong.empty()) shown += "  <- " + reading.wrong;
        if (shown == watched.shown) return;
        watched.shown = shown;
        std::cout << time << "  " << watched.name << "  " << printable(shown) << '\n';
    }

    const WatchOptions& options_;
    std::vector<Watched>& watched_;
};

std::int64_t now() {
    const auto since = std::chrono::system_clock::now().time_since_epoch();
    return std::chrono::duration_cast<std::chrono::nanoseconds>(since).count();
}

// Waits for the next moment and returns its time: a multiple of 1/rate s of the wall clock, or
// without a rate that of the next image.
std::int64_t nextMoment(const WatchOptions& options, Live& live, std::uint64_t& images) {
    if (options.rate > 0) {
        const std::int64_t step = 1'000'000'000 / options.rate;
        const std::int64_t moment = (now() / step + 1) * step;
        for (std::int64_t left = moment - now(); left > 0; left = moment - now()) {
            throwIfInterrupted();
            std::this_thread::sleep_for(
                std::min<std::chrono::nanoseconds>(std::chrono::nanoseconds{left}, interruptSlice));
        }
        return moment;
    }
    const std::uint64_t before = images;
    while (images == before && std::cout) {
        throwIfInterrupted();
        images = live.mirror().waitForImage(before, interruptSlice);
    }
    return now();
}

// What all agents that are watched have at each moment.
void run(const WatchOptions& options, Live& live, std::vector<Watched>& watched) {
    ImagePrinter printer{options, watched};
    printer.head();
    std::uint64_t images = 0;
    for (std::uint64_t lines = 0; options.count == 0 || lines < options.count; ++lines) {
        const std::int64_t moment = nextMoment(options, live, images);
        if (!std::cout) return;  // nobody reads on
        std::map<std::string, comms::AgentImage> pinned;
        std::vector<Reading> readings;
        std::set<std::string> restarted;
        for (Watched& each : watched) {
            if (follow(live, each)) restarted.insert(each.simplex.agent);
            const auto [place, added] = pinned.try_emplace(each.simplex.agent);
            if (added) place->second = live.mirror().image(each.simplex.agent);
            readings.push_back(read(each, place->second));
        }
        printer.line(timeText(moment), readings, restarted);
    }
}

}  // namespace

Exit watchValues(const WatchOptions& options) {
    Live live{options.network};
    std::vector<Watched> watched;
    std::vector<std::string> paths;
    for (const std::string& each : options.what) {
        addItems(live, each, watched);
        const SimplexInfo& info = watched.back().simplex.info();
        paths.push_back(info.path);
        if (info.role != Role::Modification) continue;
        for (const std::uint32_t writer : info.writers) {  // their states tell why it is stale
            paths.push_back(watched.back().simplex.structure->simplexes[writer].path);
        }
    }
    live.view(paths, options.rate);
    if (!live.waitForValues()) {
        throw Failure{NotFound, "not all of the values came within " +
                                    toText(options.network.timeout) + " s"};
    }
    run(options, live, watched);
    return Yes;
}

}  // namespace cortex::explorer
