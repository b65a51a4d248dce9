// SPDX-License-Identifier: Apache-2.0
#include "report/results_json.hpp"

#include "cortex/core/error.hpp"

#include <algorithm>
#include <array>

#define JSON_DIAGNOSTICS 1  // errors name the place
#include <nlohmann/json.hpp>

namespace cortex::profiler {

using Json = nlohmann::json;

namespace {

constexpr const char* format = "cortex-profiler-results";
constexpr int formatVersion = 2;
constexpr std::array aims{"none", "at most", "at least"};
constexpr std::array alongs{"x", "y"};

template <class Enum>
void readOneOf(const Json& json, const auto& names, Enum& value) {
    const auto found = std::ranges::find(names, json.get<std::string>());
    std::string known;
    for (const char* each : names) known += (known.empty() ? "'" : ", '") + std::string{each} + "'";
    if (found == names.end())
        throw Json::other_error::create(501, "must be one of " + known, &json);
    value = static_cast<Enum>(found - names.begin());
}

}  // namespace

void to_json(Json& json, Aim aim) { json = aims[static_cast<std::size_t>(aim)]; }
void from_json(const Json& json, Aim& aim) { readOneOf(json, aims, aim); }
void to_json(Json& json, Mark::Along along) { json = alongs[static_cast<std::size_t>(along)]; }
void from_json(const Json& json, Mark::Along& along) { readOneOf(json, alongs, along); }
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Axis, label, unit, logarithmic)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Point, x, y)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Series, name, points, baseline)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Mark, along, at, text)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Figure, id, title, paper, setup, x, y, series, marks)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Quantity, id, what, unit, value, repeats, baseline, baselineName,
                                   aim, limit, paper, lessIsBetter, doubt, group)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Results, started, command, version, machine, notes, quantities,
                                   figures, complete)

std::string jsonText(const Results& results) {
    Json json = results;
    json["format"] = format;
    json["formatVersion"] = formatVersion;
    return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

Results resultsOf(std::string_view text) {
    // What is not a number is written as null.
    const auto readNulls = [](int, Json::parse_event_t, Json& value) {
        if (value.is_null()) value = none;
        return true;
    };
    try {
        const Json json = Json::parse(text, readNulls);
        if (!json.is_object() || json.value("format", "") != format) {
            throw Error{"was not written by cortex-profiler"};
        }
        if (json.at("formatVersion") != formatVersion) {
            throw Error{"was written by another version of cortex-profiler"};
        }
        return json.get<Results>();
    } catch (const Json::exception& error) {
        const std::string_view what = error.what();  // "[json.exception.…] (/place) …"
        throw Error{"is not whole or not as expected: " +
                    std::string{what.substr(std::min(what.find("] ") + 2, what.size()))}};
    }
}

}  // namespace cortex::profiler
