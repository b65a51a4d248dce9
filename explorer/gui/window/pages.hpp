// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "model/abnormal.hpp"
#include "model/event_filter.hpp"
#include "model/event_past.hpp"
#include "model/state_times.hpp"
#include "views/view_host.hpp"
#include "window/pane.hpp"

#include <QJsonObject>
#include <QString>
#include <functional>
#include <string>
#include <vector>

class QMenu;

namespace cortex::gui {

// What pages are made from.
struct PageParts {
    Session& session;
    Commands& commands;
    ViewHost& host;
    const StateTimes& times;
    EventFilter& events;
    EventPast& past;
    const Abnormal& abnormal;
    std::function<void(const std::string&)> open{}, select{};  // a simplex, from within a page
    std::function<void(const std::string&, const std::string&)> item{};  // of a simplex
    std::function<QWidget*(const QString&)> kind{};                      // a view of this kind
    std::function<void(const std::vector<RecordedItem>&)> plot{};
    std::function<void(QMenu*, const std::vector<RecordedItem>&)> places{};  // to plot in
    std::function<void(const QString&)> compare{};           // an item of all simplexes
    std::function<void()> changed{};                         // something that a layout keeps
    std::function<void(const comms::AgentEvent&)> before{};  // what was before a fault
};

// A kind of page that has one tab at most.
struct PageKind {
    QString kind, title;
};

// Those that can be opened by name: of the window, and the views of plug-ins for a whole system.
std::vector<PageKind> pageKinds();

// A page of this kind, with its title. A view that is not installed is a page that says so.
std::pair<Page, QString> makePage(const PageParts& parts, const QString& kind,
                                  const QJsonObject& saved);
Page makeSimplexPage(const PageParts& parts, const std::string& path);
inline constexpr const char* overviewKind = "overview";  // the first page
// The ten seconds before a fault, as FaultHistory::saved() has it.
inline constexpr const char* beforeKind = "before";
std::pair<Page, QString> makeBeforePage(const PageParts& parts, const QJsonObject& saved);
// The simplex that a page shows; empty: it shows none.
std::string pathOf(const Page& page);

}  // namespace cortex::gui
