// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/nearest_names.hpp"

#include "live/live_values.hpp"
#include "verbs/live_verbs.hpp"

#include <algorithm>
#include <functional>
#include <iostream>
#include <map>

namespace cortex::explorer {
namespace {

// One value that is watched.
struct Watched {
    FoundSimplex simplex;
    const ItemLayout* item = nullptr;
    std::string name;   // "/arm/axis.position"
    std::string shown;  // last, with its quality
};

// What is known of a value in one image of its agent.
struct Reading {
    std::string text;
    Json value;
    Quality quality = Quality::Lost;
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
        watched.push_back({simplex, &each, path + "." + each.item->name, ""});
    }
    if (watched.size() > before) return;
    const std::string nearest = nearestNames(wanted, names);
    const std::string all = names.empty() ? "there is none" : "there are " + joined(names);
    throw Failure{NotFound, path + " (" + simplex.type().name + ") has no item '" + wanted + "'; " +
                                (nearest.empty() ? all : nearest)};
}

Reading read(const Watched& watched, const comms::AgentImage& image) {
    Reading reading;
    // A later start of the agent may have another structure: what was watched is gone with it.
    if (!image || &image->structure() != watched.simplex.structure.get()) return reading;
    reading.quality = image->state(watched.simplex.index).quality;
    const Value value = image->value(watched.simplex.index, *watched.item);
    reading.text = valueText(*watched.item->item, value);
    reading.value = valueJson(*watched.item->item, value);
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
        std::cout << std::endl;
    }
    void line(const std::string& time, const std::vector<Reading>& readings) {
        if (options_.csv) return csv(time, readings);
        if (options_.json) return json(time, readings);
        for (std::size_t i = 0; i < readings.size(); ++i) text(time, watched_[i], readings[i]);
        std::cout << std::flush;
    }

private:
    static void csv(const std::string& time, const std::vector<Reading>& readings) {
        std::cout << time;
        for (const Reading& each : readings) std::cout << ',' << csvText(each.text);
        for (const Reading& each : readings) std::cout << ',' << name(each.quality);
        std::cout << std::endl;
    }
    void json(const std::string& time, const std::vector<Reading>& readings) const {
        Json values = Json::object();
        for (std::size_t i = 0; i < readings.size(); ++i) {
            values[watched_[i].name] = {{"value", readings[i].value},
                                        {"quality", name(readings[i].quality)}};
        }
        const Json line{{"time", time}, {"values", values}};
        std::cout << line.dump(-1, ' ', false, Json::error_handler_t::replace) << std::endl;
    }
    // Only what has changed.
    static void text(const std::string& time, Watched& watched, const Reading& reading) {
        std::string shown = reading.text;
        if (!watched.item->item->unit.empty()) shown += " " + watched.item->item->unit;
        if (reading.quality != Quality::Good) shown += std::string{"  "} + name(reading.quality);
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

// A moment of all agents that are watched: that of the newest image, or of its being lost.
void run(const WatchOptions& options, Live& live, std::vector<Watched>& watched) {
    ImagePrinter printer{options, watched};
    printer.head();
    std::uint64_t images = 0;
    for (std::uint64_t lines = 0; options.count == 0 || lines < options.count; ++lines) {
        const std::uint64_t before = images;
        while (images == before && std::cout) {
            images = live.mirror().waitForImage(before, std::chrono::seconds{1});
        }
        if (!std::cout) return;  // nobody reads on
        std::map<std::string, comms::AgentImage> pinned;
        std::vector<Reading> readings;
        for (const Watched& each : watched) {
            const auto [place, added] = pinned.try_emplace(each.simplex.agent);
            if (added) place->second = live.mirror().image(each.simplex.agent);
            readings.push_back(read(each, place->second));
        }
        printer.line(timeText(now()), readings);
    }
}

}  // namespace

Exit watchValues(const WatchOptions& options) {
    Live live{options.network};
    std::vector<Watched> watched;
    std::vector<std::string> paths;
    for (const std::string& each : options.what) {
        addItems(live, each, watched);
        paths.push_back(watched.back().simplex.info().path);
    }
    live.mirror().view(paths, options.rate);
    if (!live.mirror().waitForValues(live.left())) {
        throw Failure{NotFound, "not all of the values came within " +
                                    toText(options.network.timeout) + " s"};
    }
    run(options, live, watched);
    return Yes;
}

}  // namespace cortex::explorer
