// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/clock.hpp"
#include "cortex/core/labelled_value.hpp"
#include "cortex/core/nearest_names.hpp"

#include "common/live_rule.hpp"
#include "live/live_values.hpp"
#include "live/safe_demand.hpp"
#include "text/interrupts.hpp"
#include "verbs/live_verbs.hpp"

#include <algorithm>
#include <condition_variable>
#include <deque>
#include <iostream>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <thread>
#include <utility>

namespace cortex::cli {
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
    std::string plain;  // without labels
    Json value, label;  // null: it has none
    std::string wrong;  // how it is out of its range
    Quality quality = Quality::Lost;
    StaleDemand demand{};
};

void addItems(const FoundSimplex& simplex, const std::optional<std::string>& wanted,
              std::vector<Watched>& watched) {
    const std::string& path = simplex.info().path;
    std::vector<std::string> names;
    const std::size_t before = watched.size();
    for (const ItemLayout& each : simplex.info().layout->items) {
        names.push_back(each.item->name);
        if (wanted && each.item->name != *wanted) continue;
        watched.push_back({simplex, &each, path + "." + each.item->name, each.item->name, ""});
    }
    if (!wanted || watched.size() > before) return;
    const std::string nearest = nearestNames(*wanted, names);
    const std::string all = names.empty() ? "there is none" : "there are " + joined(names);
    throw Failure{NotFound, path + " (" + simplex.type().name + ") has no item '" + *wanted +
                                "'; " + (nearest.empty() ? all : nearest)};
}

// "/" stands for all that there is.
void addWatched(Live& live, const std::string& what, std::vector<Watched>& watched) {
    if (what == "/") {
        live.waitForAll();
        live.printWarnings();
        for (const FoundSimplex& each : live.below(what)) {
            if (live.ownerOf(each.info().path) == each.agent) addItems(each, {}, watched);
        }
        return;
    }
    const std::size_t dot = what.find('.');
    addItems(live.find(what.substr(0, dot)),
             dot == std::string::npos ? std::nullopt : std::optional{what.substr(dot + 1)},
             watched);
}

// The simplexes, and who writes a demand: their states tell why it is stale.
std::vector<std::string> pathsOf(const std::vector<Watched>& watched) {
    std::set<std::string> paths;
    for (const Watched& each : watched) {
        const SimplexInfo& info = each.simplex.info();
        paths.insert(info.path);
        if (info.role != Role::Modification) continue;
        for (const std::uint32_t writer : info.writers) {
            paths.insert(each.simplex.structure->simplexes[writer].path);
        }
    }
    return {paths.begin(), paths.end()};
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

// Of one agent at one moment.
struct Pinned {
    comms::AgentImage image{};
    std::optional<comms::AgentStatus> status{};  // once somebody asks for it
};

// Whether it is the present value whatever becomes of what its simplex measures.
bool isAlwaysGood(Live& live, const Watched& watched, Pinned& agent) {
    const DataItem& item = *watched.item->item;
    const std::uint32_t index = watched.simplex.index;
    if (item.constant) return true;
    if (!common::isOfAgent(*watched.simplex.structure, index, item.name)) return false;
    if (!agent.status) agent.status = live.statusOf(watched.simplex.agent);
    return common::isHeard(*agent.status, agent.image, index);
}

Reading read(Live& live, const Watched& watched, Pinned& agent) {
    const comms::AgentImage& image = agent.image;
    Reading reading;
    const bool same = image && &image->structure() == watched.simplex.structure.get();
    if (!same || !isLive(image, watched.simplex.index)) return reading;
    reading.quality = image->state(watched.simplex.index).quality;
    const std::uint32_t index = watched.simplex.index;
    if (reading.quality != Quality::Good && isAlwaysGood(live, watched, agent))
        reading.quality = Quality::Good;
    if (reading.quality != Quality::Good)
        reading.demand = safeBecause(index, image->state(index), image);
    const Value value = image->value(watched.simplex.index, *watched.item);
    reading.text = exactText(*watched.item->item, value);
    reading.plain = plainText(*watched.item->item, value);
    reading.value = valueJson(*watched.item->item, value);
    reading.label = labelJson(*watched.item->item, value);
    reading.wrong = outsideText(*watched.item->item, value);
    return reading;
}

// What all agents that are watched have at one moment.
struct Sighting {
    std::int64_t moment = 0;
    std::vector<Reading> readings;
    std::set<std::string> restarted;  // their values are from now on those of another start
    std::string agent;                // whose image it was at every cycle
    std::int64_t cycle = 0;           // of that image
};

// Prints what was watched, once for every line.
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
    void line(const Sighting& line) {
        // A cycle may last less than a millisecond.
        const std::string time = common::utcText(line.moment, options_.rate == 0 ? 6 : 3);
        const std::vector<Reading>& readings = line.readings;
        if (options_.csv) return csv(time, readings, line.restarted);
        if (options_.json) return json(time, readings, line.restarted);
        for (const std::string& each : line.restarted) {
            for (Watched& shown : watched_) {
                if (shown.simplex.agent == each) shown.shown.clear();
            }
            std::cout << time << "  values now come from a new start of agent " << printable(each)
                      << '\n';
        }
        for (std::size_t i = 0; i < readings.size(); ++i) text(time, watched_[i], readings[i]);
        std::cout << std::flush;
    }

private:
    void csv(const std::string& time, const std::vector<Reading>& readings,
             const std::set<std::string>& restarted) const {
        std::cout << time;
        for (const Reading& each : readings)
            std::cout << ',' << csvText(options_.labels ? each.text : each.plain);
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

Sighting readAll(Live& live, std::vector<Watched>& watched, std::int64_t moment) {
    Sighting line;
    line.moment = moment;
    std::map<std::string, Pinned> pinned;
    for (Watched& each : watched) {
        if (follow(live, each)) line.restarted.insert(each.simplex.agent);
        const auto [place, added] = pinned.try_emplace(each.simplex.agent);
        if (added) place->second.image = live.mirror().image(each.simplex.agent);
        line.readings.push_back(read(live, each, place->second));
    }
    return line;
}

// The next multiple of 1/rate s of the wall clock.
std::int64_t nextMoment(std::int64_t rate) {
    const std::int64_t step = nsPerSecond / rate;
    const std::int64_t moment = (now() / step + 1) * step;
    for (std::int64_t left = moment - now(); left > 0; left = moment - now()) {
        throwIfInterrupted();
        std::this_thread::sleep_for(
            std::min<std::chrono::nanoseconds>(std::chrono::nanoseconds{left}, interruptSlice));
    }
    return moment;
}

// The lines of every cycle, from the mirror's thread, which has each image for a moment only, to
// the one that prints.
class EveryCycle {
public:
    EveryCycle(Live& live, std::vector<Watched> watched)
        : live_{live}, watched_{std::move(watched)} {}

    void add(const std::string& agent, std::int64_t cycle) {
        const std::lock_guard lock{mutex_};
        if (lines_.size() >= most) return;
        lines_.push_back(readAll(live_, watched_, now()));
        lines_.back().agent = agent;
        lines_.back().cycle = cycle;
        images_ = images();
        changed_.notify_one();
    }
    // The next line. Where none comes for a while it shows what is lost meanwhile.
    Sighting next() {
        std::unique_lock lock{mutex_};
        while (!changed_.wait_for(lock, interruptSlice, [&] { return !lines_.empty(); })) {
            throwIfInterrupted();
            if (std::exchange(images_, images()) != images_) return readAll(live_, watched_, now());
        }
        throwIfInterrupted();
        Sighting line = std::move(lines_.front());
        lines_.pop_front();
        return line;
    }

private:
    static constexpr std::size_t most = 10'000;

    // So many were published; one that comes from no block says that values are stale or lost.
    std::uint64_t images() { return live_.mirror().waitForImage(0, std::chrono::milliseconds{}); }

    std::mutex mutex_;
    std::condition_variable changed_;
    Live& live_;
    std::vector<Watched> watched_;
    std::deque<Sighting> lines_;
    std::uint64_t images_ = 0;
};

// Says on standard error how many cycles did not come, at most once a second and at the end.
class Gaps {
public:
    ~Gaps() { tell(); }
    void add(const Sighting& line) {
        if (line.agent.empty()) return;
        std::int64_t& last = last_[line.agent];
        const bool goesOn = last != 0 && !line.restarted.contains(line.agent);
        if (goesOn && line.cycle > last + 1) missing_[line.agent] += line.cycle - last - 1;
        last = line.cycle;
        if (missing_.empty() || line.moment - told_ < nsPerSecond) return;
        tell();
        told_ = line.moment;
    }

private:
    void tell() {
        for (const auto& [agent, cycles] : missing_) {
            std::cerr << "cortex: " << plural(static_cast<std::uint64_t>(cycles), "cycle") << " of "
                      << printable(agent) << " did not come\n";
        }
        missing_.clear();
    }

    std::map<std::string, std::int64_t> last_, missing_;
    std::int64_t told_ = 0;
};

void runAtRate(const WatchOptions& options, Live& live, std::vector<Watched>& watched,
               ImagePrinter& printer) {
    for (std::uint64_t lines = 0; options.count == 0 || lines < options.count; ++lines) {
        const std::int64_t moment = nextMoment(options.rate);
        if (!std::cout) return;  // nobody reads on
        printer.line(readAll(live, watched, moment));
    }
}

void runAtEveryCycle(const WatchOptions& options, Live& live, const std::vector<Watched>& watched,
                     ImagePrinter& printer) {
    struct Ending {
        ~Ending() { listening.stop(); }
        comms::Listening listening;
    };
    EveryCycle every{live, watched};
    const Ending ending{
        live.mirror().onImage([&every](const std::string& agent, const comms::AgentImage& image) {
            every.add(agent, image->cycle());
        })};
    Gaps gaps;
    for (std::uint64_t lines = 0; options.count == 0 || lines < options.count; ++lines) {
        const Sighting line = every.next();
        if (!std::cout) return;
        gaps.add(line);
        printer.line(line);
    }
}

}  // namespace

Exit watchValues(const WatchOptions& options) {
    Live live{options.network};
    std::vector<Watched> watched;
    for (const std::string& each : options.what) addWatched(live, each, watched);
    const bool all = std::ranges::find(options.what, "/") != options.what.end();
    live.view(all ? std::vector<std::string>{"/"} : pathsOf(watched), options.rate);
    if (!live.waitForValues()) {
        throw Failure{NotFound, "not all of the values came within " + live.limitText()};
    }
    ImagePrinter printer{options, watched};
    printer.head();
    if (options.rate == 0)
        runAtEveryCycle(options, live, watched, printer);
    else
        runAtRate(options, live, watched, printer);
    return Yes;
}

}  // namespace cortex::cli
