// SPDX-License-Identifier: Apache-2.0
#include "report/results_json.hpp"

#include "cortex/core/error.hpp"

#include <array>
#include <cmath>
#include <limits>

#include <nlohmann/json.hpp>

namespace cortex::profiler {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* format = "cortex-profiler-results";
constexpr int formatVersion = 1;
constexpr std::array aims{"none", "at most", "at least"};

Json numberJson(double value) { return std::isfinite(value) ? Json(value) : Json(); }

Json axisJson(const Axis& axis) {
    return {{"label", axis.label}, {"unit", axis.unit}, {"logarithmic", axis.logarithmic}};
}

Json quantityJson(const Quantity& quantity) {
    Json json{{"id", quantity.id},
              {"what", quantity.what},
              {"unit", quantity.unit},
              {"value", numberJson(quantity.value)}};
    json["repeats"] = Json::array();
    for (const double each : quantity.repeats) json["repeats"].push_back(numberJson(each));
    if (quantity.baseline) json["baseline"] = numberJson(*quantity.baseline);
    json["baselineName"] = quantity.baselineName;
    json["aim"] = aims[static_cast<std::size_t>(quantity.aim)];
    json["limit"] = numberJson(quantity.limit);
    json["paper"] = quantity.paper;
    json["lessIsBetter"] = quantity.lessIsBetter;
    return json;
}

Json figureJson(const Figure& figure) {
    Json json{{"id", figure.id},       {"title", figure.title},   {"paper", figure.paper},
              {"setup", figure.setup}, {"x", axisJson(figure.x)}, {"y", axisJson(figure.y)}};
    json["series"] = Json::array();
    for (const Series& each : figure.series) {
        Json x = Json::array(), y = Json::array();
        for (const Point& point : each.points) {
            x.push_back(numberJson(point.x));
            y.push_back(numberJson(point.y));
        }
        json["series"].push_back({{"name", each.name},
                                  {"baseline", each.baseline},
                                  {"x", std::move(x)},
                                  {"y", std::move(y)}});
    }
    json["marks"] = Json::array();
    for (const Mark& each : figure.marks) {
        json["marks"].push_back({{"along", each.along == Mark::Along::X ? "x" : "y"},
                                 {"at", numberJson(each.at)},
                                 {"text", each.text}});
    }
    return json;
}

// A value in the file and where it stands, for errors.
class Entry {
public:
    Entry(const Json& json, std::string place) : json_{json}, place_{std::move(place)} {}

    bool has(const char* key) const { return json_.is_object() && json_.contains(key); }
    Entry at(const std::string& key) const {
        const std::string inner = place_.empty() ? key : place_ + "." + key;
        if (!json_.is_object() || !json_.contains(key)) fail(inner, "is missing");
        return {json_.at(key), inner};
    }
    std::string text(const std::string& key) const {
        const Entry entry = at(key);
        if (!entry.json_.is_string()) fail(entry.place_, "must be a text");
        return entry.json_.get<std::string>();
    }
    bool truth(const std::string& key) const {
        const Entry entry = at(key);
        if (!entry.json_.is_boolean()) fail(entry.place_, "must be true or false");
        return entry.json_.get<bool>();
    }
    double number(const std::string& key) const { return at(key).number(); }
    std::vector<double> numbers(const std::string& key) const {
        std::vector<double> result;
        each(key, [&](const Entry& entry) { result.push_back(entry.number()); });
        return result;
    }
    template <class Use>
    void each(const std::string& key, Use use) const {
        const Entry list = at(key);
        if (!list.json_.is_array()) fail(list.place_, "must be a list");
        for (std::size_t i = 0; i < list.json_.size(); ++i) {
            use(Entry{list.json_[i], list.place_ + "[" + std::to_string(i) + "]"});
        }
    }
    std::string asText() const {
        if (!json_.is_string()) fail(place_, "must be a text");
        return json_.get<std::string>();
    }
    std::size_t oneOf(const std::string& key, const auto& names) const {
        const std::string found = text(key);
        std::string known;
        for (std::size_t i = 0; i < names.size(); ++i) {
            if (found == names[i]) return i;
            known += (i == 0 ? "'" : ", '") + std::string{names[i]} + "'";
        }
        fail(at(key).place_, "is '" + found + "', must be one of " + known);
    }
    [[noreturn]] void fail(const std::string& place, const std::string& what) const {
        throw Error{(place.empty() ? "the whole" : place) + " " + what};
    }
    [[noreturn]] void fail(const std::string& what) const { fail(place_, what); }

private:
    double number() const {
        if (json_.is_null()) return std::numeric_limits<double>::quiet_NaN();
        if (!json_.is_number()) fail(place_, "must be a number or null");
        return json_.get<double>();
    }

    const Json& json_;
    std::string place_;
};

Axis axisOf(const Entry& entry) {
    return {entry.text("label"), entry.text("unit"), entry.truth("logarithmic")};
}

Quantity quantityOf(const Entry& entry) {
    Quantity quantity;
    quantity.id = entry.text("id");
    quantity.what = entry.text("what");
    quantity.unit = entry.text("unit");
    quantity.value = entry.number("value");
    quantity.repeats = entry.numbers("repeats");
    if (entry.has("baseline")) quantity.baseline = entry.number("baseline");
    quantity.baselineName = entry.text("baselineName");
    quantity.aim = static_cast<Aim>(entry.oneOf("aim", aims));
    quantity.limit = entry.number("limit");
    quantity.paper = entry.text("paper");
    quantity.lessIsBetter = entry.truth("lessIsBetter");
    return quantity;
}

Series seriesOf(const Entry& entry) {
    Series series{entry.text("name"), {}, entry.truth("baseline")};
    const std::vector<double> x = entry.numbers("x"), y = entry.numbers("y");
    if (x.size() != y.size()) entry.fail("must have as many x as y");
    for (std::size_t i = 0; i < x.size(); ++i) series.points.push_back({x[i], y[i]});
    return series;
}

Figure figureOf(const Entry& entry) {
    Figure figure{entry.text("id"),
                  entry.text("title"),
                  entry.text("paper"),
                  entry.text("setup"),
                  axisOf(entry.at("x")),
                  axisOf(entry.at("y")),
                  {},
                  {}};
    entry.each("series", [&](const Entry& each) { figure.series.push_back(seriesOf(each)); });
    entry.each("marks", [&](const Entry& each) {
        const auto along = static_cast<Mark::Along>(each.oneOf("along", std::array{"x", "y"}));
        figure.marks.push_back({along, each.number("at"), each.text("text")});
    });
    return figure;
}

Json parsed(std::string_view text) {
    try {
        return Json::parse(text);
    } catch (const Json::exception& error) {
        throw Error{std::string{"is not whole or not JSON: "} + error.what()};
    }
}

}  // namespace

std::string jsonText(const Results& results) {
    Json json{{"format", format},           {"formatVersion", formatVersion},
              {"started", results.started}, {"command", results.command},
              {"version", results.version}, {"complete", results.complete}};
    json["machine"] = Json::array();
    for (const auto& [fact, value] : results.machine) {
        json["machine"].push_back({{"fact", fact}, {"value", value}});
    }
    json["notes"] = results.notes;
    json["quantities"] = Json::array();
    for (const Quantity& each : results.quantities) {
        json["quantities"].push_back(quantityJson(each));
    }
    json["figures"] = Json::array();
    for (const Figure& each : results.figures) json["figures"].push_back(figureJson(each));
    return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

Results resultsOf(std::string_view text) {
    const Json json = parsed(text);
    const Entry root{json, ""};
    if (!root.has("format") || root.text("format") != format) {
        throw Error{"was not written by cortex-profiler"};
    }
    if (root.number("formatVersion") != formatVersion) {
        throw Error{"was written by another version of cortex-profiler"};
    }
    Results results;
    results.started = root.text("started");
    results.command = root.text("command");
    results.version = root.text("version");
    results.complete = root.truth("complete");
    root.each("machine", [&](const Entry& each) {
        results.machine.emplace_back(each.text("fact"), each.text("value"));
    });
    root.each("notes", [&](const Entry& each) { results.notes.push_back(each.asText()); });
    root.each("quantities",
              [&](const Entry& each) { results.quantities.push_back(quantityOf(each)); });
    root.each("figures", [&](const Entry& each) { results.figures.push_back(figureOf(each)); });
    return results;
}

}  // namespace cortex::profiler
