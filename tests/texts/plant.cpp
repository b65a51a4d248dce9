// SPDX-License-Identifier: Apache-2.0
#include "texts/plant.hpp"

#include "cortex/core/labelled_value.hpp"
#include "cortex/core/model_files.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <sstream>
#include <utility>

namespace cortex::test {
namespace {

using nlohmann::json;

// "": each of `expected` is found so, by find(path, item).
template <class Find>
std::string differences(const AllValues& expected, Find find) {
    constexpr std::size_t most = 5, longest = 1000;
    std::string text;
    std::size_t count = 0;
    for (const auto& [path, values] : expected) {
        for (const auto& [item, value] : values) {
            const std::optional<Value> found = find(path, item);
            const std::string why = found ? difference(value, *found) : " is not there";
            if (why.empty() || ++count > most) continue;
            text += path + "." + item + why.substr(0, longest) + "\n";
        }
    }
    return count == 0 ? "" : text + std::to_string(count) + " items differ";
}

std::optional<Value> valueAt(const AllValues& values, const std::string& path,
                             const std::string& item) {
    const auto simplex = values.find(path);
    if (simplex == values.end()) return {};
    const auto found = simplex->second.find(item);
    return found == simplex->second.end() ? std::nullopt : std::optional{found->second};
}

}  // namespace

void writeTypes(const ModelFolder& folder, const std::string& types) {
    folder.write("types.xml",
                 "<ontology name='t' version='1.0'><include file='base.xml'/>\n"
                 "<type name='Carrier' extends='Active'><command name='echo' available='always'>"
                 "<request name='count' kind='int'/><request name='number' kind='float'/>"
                 "<request name='flag' kind='bool'/>"
                 "<request name='text' kind='string' capacity='200'/>"
                 "<request name='numbers' kind='float' length='3'/>"
                 "<response name='count' kind='int'/><response name='number' kind='float'/>"
                 "<response name='flag' kind='bool'/>"
                 "<response name='text' kind='string' capacity='200'/>"
                 "<response name='numbers' kind='float' length='3'/></command></type>\n" +
                     types + "</ontology>\n");
    folder.write("rules.xml",
                 "<morphology name='m' version='1.0'><include file='base-morphology.xml'/>"
                 "<include file='types.xml'/><rules type='Carrier'>"
                 "<relationship name='source' direction='input' target='Carrier' max='1'/>"
                 "</rules></morphology>\n");
}

std::size_t countOf(const AllValues& values) {
    std::size_t count = 0;
    for (const auto& [path, items] : values) count += items.size();
    return count;
}

std::size_t otherThan(const AllValues& all, const AllValues& values) {
    std::size_t count = 0;
    for (const auto& [path, items] : values) {
        for (const auto& [item, value] : items) {
            count += difference(all.at(path).at(item), value).empty() ? 0U : 1U;
        }
    }
    return count;
}

AllValues someOf(const AllValues& all, const AllValues& wanted) {
    AllValues some;
    for (const auto& [path, items] : wanted) {
        for (const auto& [item, value] : items) some[path][item] = all.at(path).at(item);
    }
    return some;
}

void replaceBy(AllValues& values, const AllValues& others) {
    for (const auto& [path, items] : others) {
        for (const auto& [item, value] : items) values[path][item] = value;
    }
}

std::optional<Value> valueOf(const DataItem& item, const json& written) {
    const json list = item.length == 1 ? json::array({written}) : written;
    try {
        switch (item.kind) {
            case Kind::Int:
                return list.get<std::vector<std::int64_t>>();
            case Kind::Float:
                return list.get<std::vector<double>>();
            case Kind::Bool:
                return list.get<std::vector<bool>>();
            case Kind::String:
                return list.get<std::vector<std::string>>();
        }
    } catch (const json::exception&) {
        return std::nullopt;
    }
    return std::nullopt;
}

Plant::Plant(Chance& chance, std::size_t types, std::size_t simplexes)
    : model{chance, types, simplexes} {
    writeTypes(folder_, model.ontology());
    system_ = folder_.write("first.xml", model.firstSystem());
    mirror_.view({"/"}, 50);
    first_.emplace(folder_, system_, withCarrier);
    second_.emplace(folder_, folder_.write("second.xml", model.secondSystem()), withCarrier);
}

std::optional<Value> Plant::valueIn(const std::string& path, const std::string& item) const {
    const comms::AgentImage image = mirror_.image(path.starts_with("/first") ? "first" : "second");
    if (!image) return {};
    const std::uint32_t index = image->structure().find(path);
    if (index == noSimplex || !image.came(index)) return {};
    return image->value(index, *image->structure().simplexes[index].layout->find(item));
}

std::string Plant::seen(const AllValues& expected) {
    const auto look = [&] {
        images_ = mirror_.waitForImage(images_, std::chrono::milliseconds{20});
        return differences(expected, [&](const std::string& path, const std::string& item) {
            return valueIn(path, item);
        });
    };
    return lookUntil(look, [](const std::string& text) { return text.empty(); });
}

std::string Plant::copied(const AllValues& first) { return seen(model.copies(first)); }

// All of it by one process.
std::string Plant::shown(const AllValues& expected) const {
    std::string lines;
    for (const auto& [path, values] : expected) lines += "show " + path + " --json --timeout 60\n";
    const Outcome outcome = cortex(
        std::vector<std::string>{"shell", folder_.write("show.txt", lines).string()} + network);
    if (outcome.exit != 0) return outcome.errors;
    std::map<std::string, json> found;
    std::istringstream stream{outcome.output};
    for (json each; stream >> std::ws && !stream.eof();) {
        stream >> each;
        found[each["path"]] = each["data"];
    }
    return differences(expected, [&](const std::string& path, const std::string& item) {
        return valueOf(model.item(path, item), found[path][item]["value"]);
    });
}

std::string Plant::saved(const std::string& name, const AllValues& expected) const {
    const json done = liveJson({"save", path(name), "/first/part"}, "save");
    EXPECT_EQ(done["items"], countOf(expected));
    Report report;
    const std::filesystem::path file = path(name);
    AllValues found;
    for (const auto& simplex : readModelFiles(std::span{&file, 1}, report).system.simplexes) {
        for (const auto& setting : simplex.settings) {
            std::string why;
            const DataItem& item = model.item(simplex.path, setting.data);
            const auto value = parseItemValue(item, setting.value, why);
            if (value) found[simplex.path][setting.data] = *value;
        }
    }
    return report.text() +
           differences(expected, [&](const std::string& path, const std::string& item) {
               return valueAt(found, path, item);
           });
}

json Plant::restored(const std::string& name) const {
    return liveJson({"restore", path(name)}, "restore");
}

std::string Plant::set(Chance& chance, const AllValues& values) {
    bool byTool = true;
    for (const auto& [path, items] : values) {
        if (byTool) {
            std::vector<std::string> words{"set", path};
            for (const auto& [item, value] : items) {
                words.push_back(item + "=" + writtenAs(chance, value));
            }
            const Outcome outcome = live(words);
            if (outcome.exit != 0) return path + ": " + outcome.output + outcome.errors;
        } else {
            const comms::CommandAnswer answer = mirror_.call(path, "set", items, patience);
            if (!answer.done()) return path + ": " + answer.text();
        }
        byTool = !byTool;
    }
    return {};
}

std::string Plant::echoed(Chance& chance) const {
    std::array<DataItem, 5> items;
    constexpr std::array kinds{Kind::Int, Kind::Float, Kind::Bool, Kind::String, Kind::Float};
    constexpr std::array names{"count", "number", "flag", "text", "numbers"};
    const std::string path = model.simplexes().front().path;
    std::vector<std::string> words{"call", path, "echo"};
    AllValues asked, answered;
    for (std::size_t i = 0; i < items.size(); ++i) {
        items[i].name = names[i];
        items[i].kind = kinds[i];
        if (kinds[i] == Kind::String) items[i].capacity = 200;
        if (items[i].name == "numbers") items[i].length = 3;
        const Value value = asked[path][names[i]] = randomValue(chance, items[i]);
        words.push_back(names[i] + ("=" + writtenAs(chance, value)));
    }
    const json response = liveJson(words, "call")["response"];
    for (const DataItem& item : items) {
        if (const auto value = valueOf(item, response[item.name])) {
            answered[path][item.name] = *value;
        }
    }
    return differences(asked, [&](const std::string& at, const std::string& item) {
        return valueAt(answered, at, item);
    });
}

void Plant::refusesToSet() const {
    const std::vector<std::pair<Kind, const char*>> wrong{
        {Kind::Int, "1e3"},     {Kind::Int, "9223372036854775808"},
        {Kind::Float, "nan"},   {Kind::Float, "-inf"},
        {Kind::Float, "1e999"}, {Kind::Float, "1e-999"},
        {Kind::Bool, "1"},      {Kind::String, "\xed\xa0\x80"}};
    const RandomSimplex& simplex = model.simplexes().front();
    std::string lines;
    for (const auto& [kind, text] : wrong) {
        const auto item =
            std::ranges::find_if(simplex.type->items, [&, of = kind](const auto& each) {
                return each.kind == of && each.length == 1 && !each.settable.empty();
            });
        lines += "set " + simplex.path + " " + item->name + "=" + text + " --timeout 60\n";
    }
    const Outcome outcome =
        cortex(std::vector<std::string>{"shell", folder_.write("set.txt", lines).string(),
                                        "--keep-going"} +
               network);
    const auto refusals = std::ranges::count_if(linesOf(outcome.errors), [](const auto& line) {
        return line.ends_with("ended with exit code 2");
    });
    EXPECT_EQ(refusals, wrong.size()) << outcome.output << outcome.errors;
}

void Plant::startAgain(const std::string& settings) {
    EXPECT_EQ(first_->endInOrder(), 0) << output();
    first_.emplace(folder_, system_,
                   withCarrier + std::vector<std::string>{"--settings", path(settings)});
}

}  // namespace cortex::test
