// SPDX-License-Identifier: Apache-2.0
#include "verbs/shell_completion.hpp"

#include "cortex/core/command.hpp"

#include "common/person_name.hpp"
#include "text/words.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <set>
#include <string_view>

namespace cortex::cli {
namespace {

enum class What {
    Nothing,
    Path,
    Item,
    Command,
    Argument,
    Setting,
    File,
    Type,
    Mine,
    Name,
    Asking,
    Verb
};

// What stands at the places of a verb; the last goes on.
struct Places {
    std::string_view verb;
    std::array<What, 3> kinds;
};
constexpr std::array<Places, 20> places{{
    {"list", {What::Path, What::Nothing, What::Nothing}},
    {"show", {What::Path, What::Nothing, What::Nothing}},
    {"watch", {What::Item, What::Item, What::Item}},
    {"call", {What::Path, What::Command, What::Argument}},
    {"set", {What::Path, What::Setting, What::Setting}},
    {"events", {What::Path, What::Nothing, What::Nothing}},
    {"top", {What::Path, What::Nothing, What::Nothing}},
    {"conform", {What::Path, What::Path, What::Path}},
    {"save", {What::File, What::Path, What::Nothing}},
    {"restore", {What::File, What::Nothing, What::Nothing}},
    {"validate", {What::File, What::File, What::File}},
    {"diff", {What::File, What::File, What::Nothing}},
    {"types", {What::Type, What::Nothing, What::Nothing}},
    {"take", {What::Path, What::Nothing, What::Nothing}},
    {"release", {What::Mine, What::Nothing, What::Nothing}},
    {"handover", {What::Mine, What::Name, What::Nothing}},
    {"ask", {What::Path, What::Nothing, What::Nothing}},
    {"grant", {What::Asking, What::Nothing, What::Nothing}},
    {"refuse", {What::Asking, What::Nothing, What::Nothing}},
    {"help", {What::Verb, What::Nothing, What::Nothing}},
}};

using Texts = std::vector<std::string>;

struct Known {
    const CLI::App& verbs;
    Session& session;
    const Texts& words;  // before the one to complete

    std::vector<std::shared_ptr<const Structure>> structures() const {
        std::vector<std::shared_ptr<const Structure>> all;
        for (const comms::AgentStatus& each : session.mirror().agents()) {
            if (auto structure = session.mirror().structure(each.name)) all.push_back(structure);
        }
        return all;
    }
    const SimplexInfo* find(const std::string& path,
                            std::shared_ptr<const Structure>& keeps) const {
        for (const auto& each : structures()) {
            const std::uint32_t index = each->find(path);
            if (index == noSimplex || each->simplexes[index].remote) continue;
            keeps = each;
            return &each->simplexes[index];
        }
        return nullptr;
    }
};

// Paths, and what several of them begin with.
Texts pathsOf(const Known& known) {
    std::set<std::string> paths{"/"};
    for (const auto& structure : known.structures()) {
        for (const SimplexInfo& info : structure->simplexes) {
            if (info.remote) continue;
            for (std::size_t end = info.path.find('/', 1); end != std::string::npos;
                 end = info.path.find('/', end + 1)) {
                paths.insert(info.path.substr(0, end));
            }
            paths.insert(info.path);
        }
    }
    return {paths.begin(), paths.end()};
}

Texts itemsOf(const Known& known, const std::string& word) {
    const std::size_t dot = word.find('.');
    if (dot == std::string::npos) return pathsOf(known);
    std::shared_ptr<const Structure> keeps;
    const SimplexInfo* info = known.find(word.substr(0, dot), keeps);
    Texts items;
    if (info == nullptr) return items;
    for (const ItemLayout& each : info->layout->items) {
        items.push_back(info->path + "." + each.item->name);
    }
    return items;
}

// Names of commands; with a command, those of its parameters, as `name=`.
Texts commandsOf(const Known& known, const std::string& command = "") {
    std::shared_ptr<const Structure> keeps;
    const SimplexInfo* info = known.words.size() > 1 ? known.find(known.words[1], keeps) : nullptr;
    Texts texts;
    if (info == nullptr) return texts;
    const CommandTable table = commandTable(*info->layout->type);
    for (const CommandTable::Entry& each : table.entries) {
        if (command.empty()) texts.emplace_back(each.name);
        if (each.name != command) continue;
        for (const ItemLayout& item : each.request.items) texts.push_back(item.item->name + "=");
    }
    return texts;
}

Texts filesOf(const std::string& word) {
    const std::string folder = word.substr(0, word.rfind('/') + 1);
    Texts files;
    std::error_code ignored;
    for (std::filesystem::directory_iterator each{folder.empty() ? "." : folder, ignored}, end;
         each != end; each.increment(ignored)) {
        const std::string name = each->path().filename().string();
        if (!name.starts_with('.'))
            files.push_back(folder + name + (each->is_directory(ignored) ? "/" : ""));
    }
    return files;
}

Texts typesOf(const Known& known) {
    Texts types;
    for (const auto& structure : known.structures()) {
        for (const auto& [name, type] : structure->types->types()) types.push_back(name);
    }
    return types;
}

Texts mineOf(const Known& known) {
    Texts prefixes;
    for (const auto& each : known.session.leases().held()) prefixes.push_back(each.prefix);
    return prefixes;
}

// A name with what a terminal obeys stands for nobody: that of the tool does.
void addPerson(Texts& names, const std::string& person) {
    if (common::shownName(person) == person) names.push_back(person);
}

// Agents, tools that hold a lease somewhere or say who uses them, and these people.
Texts namesOf(const Known& known) {
    Texts names;
    for (const comms::ToolStatus& tool : known.session.mirror().tools()) {
        names.push_back(tool.name);
        addPerson(names, tool.person);
    }
    for (const comms::AgentStatus& agent : known.session.mirror().agents()) {
        names.push_back(agent.name);
        for (const auto& each : comms::leasesOf(agent, known.session.mirror().image(agent.name))) {
            names.push_back(each.holder);
        }
    }
    std::erase(names, known.session.mirror().name());
    return names;
}

// Tools that ask for something of ours, and who uses them.
Texts askingOf(const Known& known) {
    Texts names;
    for (const Asked& each : known.session.leases().asked()) {
        names.push_back(each.tool);
        addPerson(names, each.person);
    }
    return names;
}

Texts verbsOf(const Known& known) {
    Texts names;
    for (const CLI::App* each : known.verbs.get_subcommands(nullptr)) {
        names.push_back(each->get_name());
    }
    return names;
}

Texts optionsOf(const Known& known) {
    Texts options;
    for (const CLI::App* each : known.verbs.get_subcommands(nullptr)) {
        if (each->get_name() != known.words.front()) continue;
        for (const CLI::Option* option : each->get_options()) {
            for (const std::string& name : option->get_lnames()) options.push_back("--" + name);
        }
    }
    return options;
}

Texts textsOf(What what, const Known& known, const std::string& word) {
    switch (what) {
        case What::Nothing:
            return {};
        case What::Path:
            return pathsOf(known);
        case What::Item:
            return itemsOf(known, word);
        case What::Command:
            return commandsOf(known);
        case What::Argument:
            return commandsOf(known, known.words[2]);
        case What::Setting:
            return commandsOf(known, "set");
        case What::File:
            return filesOf(word);
        case What::Type:
            return typesOf(known);
        case What::Mine:
            return mineOf(known);
        case What::Name:
            return namesOf(known);
        case What::Asking:
            return askingOf(known);
        case What::Verb:
            return verbsOf(known);
    }
    return {};
}

// What the beginning of a word says, without its quotes.
std::string meant(const std::string& begun) {
    auto words = splitWords(begun);
    if (!words) words = splitWords(begun + begun.front());
    return words && !words->empty() ? words->front() : "";
}

// As the user began to type it. A quote stays open where the text goes on.
std::string typed(const std::string& text, const std::string& begun) {
    constexpr std::string_view goesOn = "/.=";
    std::string word = asWord(text, begun);
    const bool open = !text.empty() && goesOn.find(text.back()) != std::string_view::npos;
    if (open && word.back() != text.back()) word.pop_back();
    return word;
}

}  // namespace

std::vector<std::string> completionsOf(const std::string& before, const CLI::App& verbs,
                                       Session& session) {
    const std::string begun = before.substr(lastWord(before));
    Texts words = splitWords(before.substr(0, before.size() - begun.size())).value_or(Texts{});
    const std::string word = meant(begun);
    if (!words.empty() && words.front() == "cortex") words.erase(words.begin());
    const Known known{verbs, session, words};
    if (words.empty()) return verbsOf(known);
    if (word.starts_with('-')) return optionsOf(known);
    const auto found = std::ranges::find(places, words.front(), &Places::verb);
    if (found == places.end()) return {};
    const What what = found->kinds[std::min(words.size() - 1, found->kinds.size() - 1)];
    Texts texts = textsOf(what, known, word);
    for (std::string& each : texts) each = typed(each, begun);
    return texts;
}

}  // namespace cortex::cli
