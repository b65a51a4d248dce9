// SPDX-License-Identifier: Apache-2.0
#include "window/pages.hpp"

#include "drive/drive_views.hpp"
#include "motion/motion_views.hpp"
#include "plots/plot_view.hpp"
#include "plugin/plugins.hpp"
#include "views/agent_view.hpp"
#include "views/base_view.hpp"
#include "views/compare_view.hpp"
#include "views/event_view.hpp"
#include "views/fault_history_view.hpp"
#include "views/graph_view.hpp"
#include "views/manual_view.hpp"
#include "views/overview_view.hpp"
#include "views/own_view.hpp"
#include "widgets/empty_page.hpp"

#include <QCoreApplication>
#include <array>
#include <utility>

namespace cortex::gui {

namespace {

// What a view of ours says of its units.
template <typename View>
UnitsOfView unitsOf(View* view) {
    return {[view] { return view->units(); },
            [view](const ShownUnits& units) { view->setUnits(units); }};
}

using FramePointer = std::shared_ptr<const Frame>;

const QString ownPrefix = QStringLiteral("view:");

QString titleIn(const char* text) { return QCoreApplication::translate("Pages", text); }

// Whether the event is among those that are shown: it may be hidden, or no longer kept.
bool openEvent(const PageParts& parts, const std::string& key) {
    const EventFilter& events = parts.events;
    std::size_t row = events.rows();
    while (row > 0 && lastKey(events.shownAt(row - 1).event) != key) --row;
    if (row == 0) return false;
    const std::uint64_t serial = events.shownSerial(row - 1);
    auto* view = qobject_cast<EventView*>(parts.kind(QStringLiteral("events")));
    if (view != nullptr) view->choose(serial);
    return view != nullptr;
}

Page overviewPage(const PageParts& parts) {
    auto* view = new OverviewView{parts.abnormal, parts.times, parts.events.events()};
    ManualView::helpOf(*view, titleIn("The first page"));
    QObject::connect(view, &OverviewView::opened, view, parts.open);
    QObject::connect(view, &OverviewView::itemOpened, view, parts.item);
    QObject::connect(view, &OverviewView::eventsOpened, view,
                     [open = parts.kind] { open(QStringLiteral("events")); });
    QObject::connect(view, &OverviewView::eventOpened, view, [view, parts](const OverviewRow& row) {
        if (!openEvent(parts, row.key)) view->openAt(row);
    });
    QObject::connect(view, &OverviewView::agentOpened, view,
                     [open = parts.kind](const std::string& name) {
                         auto* agents = qobject_cast<AgentView*>(open(QStringLiteral("agents")));
                         if (!name.empty()) agents->choose(name);
                     });
    return {QLatin1String{overviewKind}, view,
            [view](const FramePointer& now) { view->refresh(now); }};
}

Page systemPage(const PageParts& parts) {
    auto* view = new GraphView;
    QObject::connect(view, &GraphView::opened, view, parts.open);
    return {QStringLiteral("system"), view,
            [view](const FramePointer& now) { view->refresh(now); }};
}

Page agentsPage(const PageParts& parts) {
    auto* view = new AgentView;
    ManualView::helpOf(*view, titleIn("Agents"));
    QObject::connect(view, &AgentView::opened, view, parts.open);
    QObject::connect(view, &AgentView::plotWanted, view, parts.plot);
    Page page{QStringLiteral("agents"), view,
              [view](const FramePointer& now) { view->refresh(*now); },
              [view] { return view->saved(); }};
    page.goesOn = true;  // it remembers what loops did in the last minutes
    return page;
}

Page eventsPage(const PageParts& parts) {
    auto* view = new EventView{parts.events, parts.session.options(), &parts.past};
    ManualView::helpOf(*view, titleIn("Events and the past"));
    QObject::connect(view, &EventView::opened, view, parts.open);
    QObject::connect(view, &EventView::beforeWanted, view, parts.before);
    return {QStringLiteral("events"), view, [view](const FramePointer&) { view->refresh(); }};
}

Page manualPage(const PageParts& /*parts*/) {
    return {QStringLiteral("manual"), new ManualView, [](const FramePointer&) {}};
}

Page plotPage(const PageParts& parts) {
    auto* view = new PlotView{parts.session.recorder()};
    ManualView::helpOf(*view, titleIn("Trends"));
    Page page{QStringLiteral("plot"), view, [view](const FramePointer& now) { view->refresh(now); },
              [view] { return view->saved(); }};
    page.goesOn = true;
    page.units = unitsOf(view);
    QObject::connect(view, &PlotView::changed, view, parts.changed);
    return page;
}

Page comparePage(const PageParts& parts) {
    auto* view = new CompareView;
    ManualView::helpOf(*view, titleIn("Comparing"));
    QObject::connect(view, &CompareView::opened, view, parts.open);
    QObject::connect(view, &CompareView::plotWanted, view, parts.plot);
    QObject::connect(view, &CompareView::placesWanted, view, parts.places);
    QObject::connect(view, &CompareView::unitsChanged, view, parts.changed);
    return {QStringLiteral("compare"),
            view,
            [view](const FramePointer& now) { view->refresh(now); },
            [view] { return view->saved(); },
            [view](const Frame&) { return Wanted{view->paths(), {}}; },
            unitsOf(view),
            [view] { return view->chosenItems(); }};
}

struct FixedPage {
    const char *kind, *title;
    Page (*make)(const PageParts&);
    bool standard;  // there from the start, without a button that closes it
};

constexpr std::array fixedPages{
    FixedPage{overviewKind, QT_TRANSLATE_NOOP("Pages", "Overview"), &overviewPage, true},
    FixedPage{"system", QT_TRANSLATE_NOOP("Pages", "System"), &systemPage, true},
    FixedPage{"agents", QT_TRANSLATE_NOOP("Pages", "Agents"), &agentsPage, true},
    FixedPage{"events", QT_TRANSLATE_NOOP("Pages", "Events"), &eventsPage, true},
    FixedPage{"plot", QT_TRANSLATE_NOOP("Pages", "Plot"), &plotPage, false},
    FixedPage{"compare", QT_TRANSLATE_NOOP("Pages", "Compare"), &comparePage, false},
    FixedPage{"manual", QT_TRANSLATE_NOOP("Pages", "Manual"), &manualPage, false},
};

// A view that does not say what it shows is given everything.
Wanted wantedBy(const OwnView& view) {
    if (view.type() == nullptr || !view.isVisible()) return {};
    if (view.watches().empty()) return {{"/"}, {}};
    return {{}, view.watches()};
}

Page ownPage(const PageParts& parts, const ViewType& type, const QJsonObject& saved) {
    auto* view = new OwnView{parts.host};
    view->show(type, {});
    view->restore(saved);
    QObject::connect(view, &OwnView::opened, view, parts.open);
    QObject::connect(view, &OwnView::selected, view, parts.select);
    return {ownPrefix + QLatin1String{type.name}, view,
            [view](const FramePointer& now) { view->refresh(*now); },
            [view] { return view->saved(); }, [view](const Frame&) { return wantedBy(*view); }};
}

// Of a simplex and of what it is related to, which its table shows as well.
Wanted wantedBy(BaseView& view, const Frame& now) {
    Wanted wanted = wantedBy(view.own());
    if (view.path().empty()) return wanted;
    wanted.usual.push_back(view.path());
    if (const auto place = now.find(view.path())) {
        const Structure& structure = *now.agents[place->agent].structure;
        for (const Edge& each : structure.edges) {
            if (each.owner == place->simplex && each.target != noSimplex)
                wanted.usual.push_back(structure.simplexes[each.target].path);
        }
    }
    return wanted;
}

// A page of a layout that cannot be made here. It keeps its place, and what it had saved.
Page missingPage(const QString& kind, const QJsonObject& saved) {
    auto* widget = new EmptyPage;
    QString name = kind;
    if (name.startsWith(ownPrefix)) name.remove(0, ownPrefix.size());
    widget->show(titleIn("View “%1” is not installed.").arg(name),
                 titleIn("The layout keeps its place."));
    return {kind, widget, [](const FramePointer&) {}, [saved] { return saved; }};
}

}  // namespace

std::vector<PageKind> pageKinds() {
    std::vector<PageKind> kinds;
    for (const FixedPage& each : fixedPages) {
        kinds.push_back({QLatin1String{each.kind}, titleIn(each.title)});
    }
    for (const ViewType* each : Plugins::all().ofSystem()) {
        kinds.push_back({ownPrefix + QLatin1String{each->name}, QString::fromUtf8(each->title)});
    }
    return kinds;
}

std::pair<Page, QString> makePage(const PageParts& parts, const QString& kind,
                                  const QJsonObject& saved) {
    if (kind == QLatin1String{"simplex"}) {
        const std::string path = saved[QStringLiteral("path")].toString().toStdString();
        Page page = makeSimplexPage(parts, path);
        page.units.choose(ShownUnits::restored(saved[QStringLiteral("units")].toArray()));
        return {std::move(page), path.empty() ? titleIn("Simplex") : QString::fromStdString(path)};
    }
    if (kind == QLatin1String{beforeKind}) return makeBeforePage(parts, saved);
    for (const FixedPage& each : fixedPages) {
        if (kind != QLatin1String{each.kind}) continue;
        Page page = each.make(parts);
        page.closable = !each.standard;
        if (auto* plot = qobject_cast<PlotView*>(page.widget)) plot->restore(saved);
        if (auto* table = qobject_cast<CompareView*>(page.widget)) table->restore(saved);
        if (auto* agents = qobject_cast<AgentView*>(page.widget)) agents->restore(saved);
        return {std::move(page), titleIn(each.title)};
    }
    for (const ViewType* each : Plugins::all().ofSystem()) {
        if (kind == ownPrefix + QLatin1String{each->name})
            return {ownPage(parts, *each, saved), QString::fromUtf8(each->title)};
    }
    return {missingPage(kind, saved), kind.mid(kind.indexOf(':') + 1)};
}

Page makeSimplexPage(const PageParts& parts, const std::string& path) {
    Plugins::all().add(explorer::motionViews());
    Plugins::all().add(explorer::driveViews());
    auto* view = new BaseView{parts.commands, parts.host, parts.times};
    view->show(path);
    QObject::connect(view, &BaseView::opened, view, parts.open);
    QObject::connect(view, &BaseView::selected, view, parts.select);
    QObject::connect(view, &BaseView::beforeWanted, view, parts.before);
    QObject::connect(view, &BaseView::plotWanted, view, parts.plot);
    QObject::connect(view, &BaseView::placesWanted, view, parts.places);
    QObject::connect(view, &BaseView::compareWanted, view, parts.compare);
    QObject::connect(view, &BaseView::unitsChanged, view, parts.changed);
    QObject::connect(
        view, &BaseView::dismissed, view,
        [&session = parts.session](const std::string& agent) { session.dismiss(agent); });
    return {QStringLiteral("simplex"),
            view,
            [view](const FramePointer& now) { view->refresh(now); },
            [view] {
                return QJsonObject{{QStringLiteral("path"), QString::fromStdString(view->path())},
                                   {QStringLiteral("units"), view->units().saved()}};
            },
            [view](const Frame& now) { return wantedBy(*view, now); },
            unitsOf(view),
            [view] { return view->chosenItems(); }};
}

std::pair<Page, QString> makeBeforePage(const PageParts& parts, const QJsonObject& saved) {
    auto* view = new FaultHistoryView{FaultHistory::restored(saved), parts.past};
    ManualView::helpOf(*view, titleIn("Events and the past"));
    QObject::connect(view, &FaultHistoryView::opened, view, parts.open);
    Page page{QLatin1String{beforeKind}, view,
              [view](const FramePointer& now) { view->refresh(*now); },
              [view] { return view->history().saved(); }};
    return {std::move(page), view->history().title()};
}

std::string pathOf(const Page& page) {
    const auto* view = qobject_cast<const BaseView*>(page.widget);
    return view != nullptr ? view->path() : std::string{};
}

}  // namespace cortex::gui
