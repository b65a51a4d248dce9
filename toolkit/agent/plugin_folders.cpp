// SPDX-License-Identifier: Apache-2.0
#include "plugin_folders.hpp"

#include "cortex/core/error.hpp"
#include "cortex/core/printable.hpp"
#include "cortex/cs/cluster_cs.hpp"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <sstream>
#include <string_view>
#include <utility>

namespace cortex::toolkit {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view packageWord = "package";
constexpr std::string_view byteOrderMark = "\xef\xbb\xbf";

std::string printed(const fs::path& path) { return printable(path.string()); }

// A shared object that may be loaded, as the file of its types describes it.
struct Offer {
    fs::path list, library;
    std::string package{};             // of Debian, that brings the library; may be empty
    std::vector<std::string> types{};  // sorted
    ClassRegistry classes{};
    bool isLoaded = false;

    const ClassRegistry::Factory& load(const std::string& type, const TypeModel& model);
    void compare() const;
};

void requireListed(const std::vector<std::string>& all, const std::vector<std::string>& of,
                   const std::string& text, const std::string& remedy) {
    for (const std::string& type : all) {
        if (!std::ranges::binary_search(of, type)) throw Error(text + type + remedy);
    }
}

// Otherwise what a system gets would depend on what was loaded before.
void Offer::compare() const {
    const std::string plugin = "plug-in " + printed(library), file = printed(list);
    requireListed(types, classes.names(), plugin + " has no class for type ",
                  ", which " + file + " lists; take the line out, or add the class");
    requireListed(classes.names(), types, plugin + " has a class for type ",
                  ", which " + file + " does not list; add it there");
}

const ClassRegistry::Factory& Offer::load(const std::string& type, const TypeModel& model) {
    if (isLoaded) return *classes.find(type);
    std::error_code ignored;
    if (!fs::exists(library, ignored)) {
        throw Error(
            printed(library) + " is not there, and " + printed(list) + " says that " + type +
            " is in it; " +
            (package.empty() ? "put it there, or remove the list" : "install package " + package));
    }
    const cs::BoundedStep step{"loading the plug-in " + printed(library)};
    classes.loadPlugin(library, model);
    compare();
    isLoaded = true;
    std::cout << "plug-in " << printed(library) << ": loaded for " << type << std::endl;
    return *classes.find(type);
}

std::string trimmed(std::string line) {
    line.resize(std::min(line.size(), line.find('#')));
    const auto isBlank = [](unsigned char c) { return std::isspace(c) != 0; };
    line.erase(line.begin(), std::ranges::find_if_not(line, isBlank));
    while (!line.empty() && isBlank(static_cast<unsigned char>(line.back()))) line.pop_back();
    return line;
}

bool isName(std::string_view text) {
    return !text.empty() && std::ranges::all_of(text, [](unsigned char c) {
        return std::isalnum(c) != 0 || c == '_' || c == '-';
    });
}

bool isOfPackage(std::string_view line) {
    if (!line.starts_with(packageWord)) return false;
    return line.size() == packageWord.size() ||
           std::isspace(static_cast<unsigned char>(line[packageWord.size()])) != 0;
}

// As the ontology writes it; "": it has no such type, or just that.
std::string writtenOtherwise(const std::string& name, const TypeModel& types) {
    const auto isSame = [](unsigned char one, unsigned char other) {
        return std::tolower(one) == std::tolower(other);
    };
    if (types.find(name) != nullptr) return {};
    for (const auto& [each, type] : types.types()) {
        if (std::ranges::equal(each, name, isSame)) return each;
    }
    return {};
}

// "" or what is wrong.
std::string readList(Offer& offer, const TypeModel& types) {
    std::ifstream in{offer.list};
    std::string line;
    for (int number = 1; std::getline(in, line); ++number) {
        if (number == 1 && line.starts_with(byteOrderMark)) line.erase(0, byteOrderMark.size());
        const std::string text = trimmed(line);
        const bool isPackage = isOfPackage(text);
        const std::string name = isPackage ? trimmed(text.substr(packageWord.size())) : text;
        if (text.empty()) continue;
        if (isPackage && name.empty()) {
            return printed(offer.list) + ":" + std::to_string(number) +
                   ": 'package' has no name; write 'package NAME', or take the line out";
        }
        if (!isName(name)) {
            return printed(offer.list) + ":" + std::to_string(number) + ": '" + printable(text) +
                   "' is no name of a type; write one in each line, or 'package NAME'";
        }
        const std::string right = isPackage ? "" : writtenOtherwise(name, types);
        if (!right.empty()) {
            return printed(offer.list) + ":" + std::to_string(number) + ": type " + name +
                   " is written " + right + " in the ontology; write it so";
        }
        if (isPackage)
            offer.package = name;
        else
            offer.types.push_back(name);
    }
    std::ranges::sort(offer.types);
    const auto twice = std::ranges::unique(offer.types);
    offer.types.erase(twice.begin(), twice.end());
    if (!offer.types.empty()) return "";
    return printed(offer.list) +
           ": no type could be read from it; let it list those of its plug-in, one in a line";
}

using Found = std::map<std::string, std::vector<std::shared_ptr<Offer>>>;  // by type

// In the order of names. To open what is no file, such as a pipe, might wait without an end.
std::vector<fs::path> filesOf(const fs::path& folder, std::vector<std::string>& problems) {
    std::error_code error;
    std::vector<fs::path> files;
    for (fs::directory_iterator each{folder, error}, end; !error && each != end;
         each.increment(error)) {
        const fs::path& path = each->path();
        if (each->is_regular_file(error))
            files.push_back(path);
        else if (path.extension() == ".types" || path.extension() == ".so")
            problems.push_back(printed(path) + " is no file; put one there, or take it away");
        error.clear();
    }
    std::ranges::sort(files);
    return files;
}

// Of one folder.
Found look(const fs::path& folder, const TypeModel& types, std::vector<std::string>& problems) {
    std::error_code error;
    Found found;
    for (const fs::path& file : filesOf(folder, problems)) {
        fs::path other = file;
        if (file.extension() == ".so" && !fs::exists(other.replace_extension(".types"), error)) {
            problems.push_back(printed(file) + " is never loaded: " + printed(other.filename()) +
                               " is not beside it; let that list its types, one in a line");
        }
        if (file.extension() != ".types") continue;
        auto offer = std::make_shared<Offer>();
        offer->list = file;
        offer->library = other.replace_extension(".so");
        if (std::string wrong = readList(*offer, types); !wrong.empty()) {
            problems.push_back(std::move(wrong));
            continue;
        }
        for (const std::string& type : offer->types) found[type].push_back(offer);
    }
    return found;
}

ClassRegistry::Factory factoryFor(const std::string& type,
                                  const std::vector<std::shared_ptr<Offer>>& offers,
                                  const std::shared_ptr<const TypeModel>& types) {
    return [type, offers, types](Simplex::Identity identity) {
        const std::string who = identity.path + " (" + identity.type->name + "): ";
        if (offers.size() > 1) {
            throw Error(who + printed(offers[0]->list) + " and " + printed(offers[1]->list) +
                        " both list type " + type +
                        "; take it out of one, or name the plug-in by --plugin");
        }
        const ClassRegistry::Factory* make = nullptr;
        try {
            make = &offers[0]->load(type, *types);
        } catch (const Error& error) {
            throw Error(who + error.what());
        }
        return (*make)(std::move(identity));
    };
}

std::vector<fs::path> pluginFolders(std::vector<std::string>& problems) {
    std::vector<fs::path> folders;
    std::error_code error;
    const char* named = std::getenv("CORTEX_AGENT_PLUGINS");
    std::istringstream in{named != nullptr ? named : ""};
    for (std::string folder; std::getline(in, folder, ':');) {
        if (folder.empty()) continue;
        folders.emplace_back(folder);
        if (fs::is_directory(folder, error)) continue;
        problems.push_back("CORTEX_AGENT_PLUGINS names " + printed(folder) +
                           ", which is no folder; correct it, or make the folder");
    }
    if (const char* home = std::getenv("HOME"))
        folders.push_back(fs::path{home} / ".local/lib/cortex/agent");
    const fs::path program = fs::read_symlink("/proc/self/exe", error);
    if (!error)
        folders.push_back((program.parent_path() / CORTEX_AGENT_PLUGINS).lexically_normal());
    return folders;
}

}  // namespace

std::vector<std::string> offerPlugins(const std::shared_ptr<const TypeModel>& types,
                                      ClassRegistry& registry) {
    std::vector<std::string> problems;
    for (const fs::path& folder : pluginFolders(problems)) {
        for (const auto& [type, offers] : look(folder, *types, problems)) {
            if (registry.find(type) != nullptr) continue;
            registry.addFactory(type, factoryFor(type, offers, types));
        }
    }
    return problems;
}

}  // namespace cortex::toolkit
