// SPDX-License-Identifier: Apache-2.0
#include "program/options.hpp"

#include "cortex/core/nearest_names.hpp"

#include "common/person_name.hpp"
#include "record/recorded_item.hpp"

#include <QString>
#include <algorithm>
#include <exception>
#include <iostream>
#include <utility>

#include <CLI/CLI.hpp>

namespace cortex::gui {

namespace {

// "1280x800".
QSize sizeFrom(const std::string& text) {
    const QStringList parts = QString::fromStdString(text).split('x');
    return parts.size() == 2 ? QSize{parts[0].toInt(), parts[1].toInt()} : QSize{};
}

std::string checkSize(const std::string& text) {
    const QSize size = sizeFrom(text);
    const bool fits = size.width() >= 800 && size.height() >= 600 && size.width() <= 8192 &&
                      size.height() <= 8192;
    return fits ? std::string{} : "a size is written as 1280x800, from 800x600 to 8192x8192";
}

std::string checkView(const std::string& name) {
    const std::vector<std::string> known{"overview", "simplex", "data",   "relationships",
                                         "commands", "type",    "system", "agents",
                                         "events",   "compare", "manual"};
    if (name.starts_with("view:") || std::ranges::find(known, name) != known.end()) return {};
    return "there is no view " + name + "; " + nearestNames(name, known);
}

std::string checkItem(const std::string& text) {
    return recordedItem(text) ? std::string{}
                              : "an item is written as /drives/4.position or /arm.pose[3]";
}

std::string checkPerson(const std::string& name) {
    try {
        common::personName(name);
    } catch (const std::exception& error) {
        return error.what();
    }
    return {};
}

}  // namespace

std::optional<Options> parseOptions(int argc, char** argv, int& exit) {
    CLI::App app{"Shows every agent of a domain, with no prior knowledge of them.",
                 "cortex-explorer"};
    Options options;
    std::string theme = "light", size = "1280x800";
    try {
        options.network = {};
    } catch (const std::exception& error) {
        std::cerr << "error: " << error.what() << '\n';
        exit = 2;
        return std::nullopt;
    }
    app.set_version_flag("--version", CORTEX_VERSION);
    app.add_option("paths", options.paths, "Simplexes to open, each in a tab")->type_name("PATH");
    app.add_option("--domain", options.network.domain, "DDS domain; otherwise CORTEX_DOMAIN, or 0")
        ->check(CLI::Range(0, comms::lastDomain));
    app.add_option("--interface", options.network.interfaces,
                   "Network interface or its address; may be given again; otherwise "
                   "CORTEX_INTERFACE, or all")
        ->allow_extra_args(false)  // what follows is a path
        ->type_name("NAME");
    app.add_option("--peer", options.network.peers, "Host that multicast does not reach")
        ->allow_extra_args(false)
        ->type_name("HOST[:PORT]");
    app.add_option("--discovery-server", options.network.discoveryServer,
                   "Fast DDS Discovery Server; otherwise CORTEX_DISCOVERY_SERVER")
        ->type_name("HOST[:PORT]");
    app.add_option("--security", options.network.security,
                   "Folder made by `cortex security create-agent`; otherwise CORTEX_SECURITY")
        ->type_name("FOLDER");
    app.add_option("--name", options.person,
                   "Who you are: others see it beside what you control; otherwise user@host")
        ->check(CLI::Validator{checkPerson, "NAME"});
    app.add_option("--view", options.view,
                   "What to show at first: overview, simplex, data, relationships, commands, type, "
                   "system, agents, events, compare, manual, or view:NAME of a plug-in")
        ->check(CLI::Validator{checkView, "NAME"});
    app.add_option("--layout", options.layout,
                   "Arrange the window as this file says, which the menu has saved; nothing is "
                   "saved by itself then")
        ->check(CLI::ExistingFile)
        ->type_name("FILE");
    app.add_option("--plot", options.plot,
                   "Plot of these items, as /drives/4.position or /arm.pose[3]")
        ->check(CLI::Validator{checkItem, "ITEM"});
    app.add_option("--filter", options.filter, "Filter of the tree")->type_name("TEXT");
    app.add_option("--rate", options.rate,
                   "How often values are taken, in Hz; 0: in every cycle of their agent")
        ->check(CLI::IsMember({5, 30, 100, 0}))
        ->capture_default_str();
    app.add_option("--theme", theme, "Colours")
        ->check(CLI::IsMember({"light", "dark", "high-contrast"}))
        ->capture_default_str();
    app.add_option("--font-scale", options.scale, "Size of text and everything else")
        ->check(CLI::Range(1.0, 1.5))
        ->capture_default_str();
    const auto* sized = app.add_option("--size", size, "Of the window in pixels")
                            ->check(CLI::Validator{checkSize, "WxH"})
                            ->capture_default_str();
    app.add_option("--screenshot", options.screenshot,
                   "Write a picture (.png) once everything has come, and end; needs no display")
        ->type_name("FILE");
    std::pair<double, std::string> measured{0, {}};
    app.add_option("--measure", measured,
                   "Write what a frame costs, as JSON, after so many seconds, and end; needs no "
                   "display")
        ->type_name("SECONDS FILE");
    app.add_option("--timeout", options.timeout, "Seconds that a screenshot waits for everything")
        ->check(CLI::Range(0.1, 600.0))
        ->capture_default_str();
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        exit = app.exit(error) == 0 ? 0 : 2;
        return std::nullopt;
    }
    options.theme = *themeNamed(QString::fromStdString(theme));
    options.size = sizeFrom(size);
    options.sized = sized->count() > 0;
    options.measureSeconds = measured.first;
    options.measureFile = measured.second;
    return options;
}

}  // namespace cortex::gui
