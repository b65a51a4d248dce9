// SPDX-License-Identifier: Apache-2.0
#include "window/workspace.hpp"

#include "plots/plot_view.hpp"
#include "views/base_view.hpp"
#include "views/compare_view.hpp"
#include "views/own_view.hpp"

#include <QApplication>
#include <QSplitter>
#include <QVBoxLayout>
#include <algorithm>
#include <chrono>
#include <utility>

namespace cortex::gui {

namespace {

constexpr std::size_t mostClosed = 20;
constexpr auto keptFor = std::chrono::minutes{5};

QString key(const char* name) { return QLatin1String{name}; }

QJsonObject savedPage(const Page& page) {
    QJsonObject saved{{key("kind"), page.kind}};
    if (page.saved) saved[key("state")] = page.saved();
    if (page.pinned) saved[key("pinned")] = true;
    return saved;
}

}  // namespace

Workspace::Workspace(PageParts parts, QWidget* parent)
    : QWidget{parent},
      parts_{std::move(parts)},
      sides_{new QSplitter{Qt::Horizontal}},
      panes_{new Pane{tr("Views")}, new Pane{tr("Views on the right")}} {
    parts_.open = [this](const std::string& path) { open(path); };
    parts_.item = [this](const std::string& path, const std::string& item) {
        open(path);
        if (auto* view = qobject_cast<BaseView*>(current())) view->enter("data", item);
    };
    parts_.kind = [this](const QString& kind) { return openKind(kind); };
    parts_.plot = [this](const std::vector<RecordedItem>& items) { openPlot(items); };
    parts_.places = [this](QMenu* menu, const std::vector<RecordedItem>& items) {
        addPlaces(*menu, items);
    };
    parts_.compare = [this](const QString& item) {
        qobject_cast<CompareView*>(openKind(key("compare")))->compare(item.toStdString());
    };
    parts_.changed = [this] { Q_EMIT changed(); };
    parts_.before = [this](const comms::AgentEvent& fault) { openBefore(fault); };
    release_.setSingleShot(true);
    connect(&release_, &QTimer::timeout, this,
            [this] { parts_.session.recorder().record(this, {}); });
    parts_.select = [this](const std::string& path) { Q_EMIT chosen(path); };
    sides_->setChildrenCollapsible(false);
    auto* rows = new QVBoxLayout{this};
    rows->setContentsMargins(0, 0, 0, 0);
    rows->addWidget(sides_);
    for (std::size_t i = 0; i < panes_.size(); ++i) connectPane(i);
    clear();
    addOverview();
    for (const char* kind : {"system", "agents", "events"}) {
        auto [page, title] = makePage(parts_, key(kind), {});
        panes_[0]->add(std::move(page), title, panes_[0]->count());
    }
    panes_[0]->choose(0);
    hideEmpty();
    connect(qApp, &QApplication::focusChanged, this, [this](QWidget*, QWidget* now) {
        for (std::size_t i = 0; i < panes_.size(); ++i) {
            if (now != nullptr && panes_[i]->isAncestorOf(now)) active_ = i;
        }
    });
}

void Workspace::connectPane(std::size_t index) {
    Pane* pane = panes_[index];
    sides_->addWidget(pane);
    connect(pane, &Pane::changed, this, &Workspace::changed);
    connect(pane, &Pane::currentChanged, this, &Workspace::currentChanged);
    connect(pane, &Pane::touched, this, [this, index] { active_ = index; });
    connect(pane, &Pane::closing, this, [this, index](int tab) { remember(index, tab); });
    connect(pane, &Pane::moveWanted, this, [this, index](int tab) { move(index, tab); });
    connect(pane, &Pane::changed, this, &Workspace::hideEmpty);
    connect(pane, &Pane::itemsDropped, this,
            [this, index](const std::vector<RecordedItem>& items, int tab) {
                active_ = index;
                if (tab < 0) return newPlot(items);
                plotIn(*qobject_cast<PlotView*>(panes_[index]->page(tab).widget), items, -1);
            });
}

void Workspace::hideEmpty() {
    panes_[1]->setVisible(panes_[1]->count() > 0);
    if (panes_[1]->count() == 0) active_ = 0;
}

// Only the tab that stays.
void Workspace::clear() {
    for (Pane* pane : panes_) {
        while (pane->count() > 0) pane->discard(0);
    }
    Page first = makeSimplexPage(parts_, {});
    first.stays = true;
    panes_[0]->add(std::move(first), tr("Simplex"), 0);
}

// Leftmost.
void Workspace::addOverview() {
    auto [page, title] = makePage(parts_, key(overviewKind), {});
    panes_[0]->add(std::move(page), title, 0);
}

// Before the views that are there from the start.
int Workspace::place(const Pane& pane) const {
    int at = pane.count();
    while (at > 0 && !pane.page(at - 1).closable && !pane.page(at - 1).stays) --at;
    return at;
}

int Workspace::placeOf(const Page& page, const Pane& pane) const {
    if (page.closable) return place(pane);
    return page.kind == key(overviewKind) ? 0 : pane.count();
}

// The tab that shows what is chosen: the one in front, otherwise the first; -1: all are pinned.
int Workspace::follower(const Pane& pane) const {
    const auto follows = [&](int tab) {
        return tab >= 0 && pane.page(tab).kind == key("simplex") && !pane.page(tab).pinned;
    };
    if (follows(pane.chosen())) return pane.chosen();
    for (int tab = 0; tab < pane.count(); ++tab) {
        if (follows(tab)) return tab;
    }
    return -1;
}

// A pinned tab that shows it is gone to: there are no two tabs of one simplex in a pane.
void Workspace::open(const std::string& path) {
    const int tab = showing(pane(), path);
    tab >= 0 ? pane().choose(tab) : follow(path);
    Q_EMIT chosen(path);
}

void Workspace::follow(const std::string& path) {
    if (follower(pane()) < 0) active_ = 0;
    int tab = follower(pane());
    if (tab < 0) tab = addSimplex(path, false);
    pane().choose(tab);
    auto* view = qobject_cast<BaseView*>(pane().page(tab).widget);
    if (view->path() != path) view->show(path);
    pane().setTitle(tab, QString::fromStdString(path));
}

bool Workspace::select(const std::string& path) {
    const Page* page = pane().current();
    auto* own = page != nullptr ? qobject_cast<OwnView*>(page->widget) : nullptr;
    return own != nullptr && own->select(path);
}

void Workspace::openTab(const std::string& path, bool beside) {
    if (beside) active_ = 1 - active_;
    int tab = showing(pane(), path);
    if (tab < 0) tab = addSimplex(path, true);
    if (!pane().page(tab).pinned) pane().setPinned(tab, true);
    pane().choose(tab);
    Q_EMIT chosen(path);
}

// The tab of this simplex, a pinned one rather than the one that follows; -1: there is none.
int Workspace::showing(const Pane& pane, const std::string& path) const {
    int found = -1;
    for (int tab = 0; tab < pane.count(); ++tab) {
        if (path.empty() || pathOf(pane.page(tab)) != path) continue;
        if (pane.page(tab).pinned) return tab;
        if (found < 0) found = tab;
    }
    return found;
}

int Workspace::addSimplex(const std::string& path, bool pinned) {
    Page page = makeSimplexPage(parts_, path);
    page.pinned = pinned;
    return pane().add(std::move(page), QString::fromStdString(path), place(pane()));
}

QWidget* Workspace::openKind(const QString& kind) {
    for (std::size_t i = 0; i < panes_.size(); ++i) {
        const int tab = panes_[i]->find(kind);
        if (tab < 0) continue;
        active_ = i;
        panes_[i]->choose(tab);
        return current();
    }
    auto [page, title] = makePage(parts_, kind, {});
    const int at = placeOf(page, pane());
    pane().choose(pane().add(std::move(page), title, at));
    return current();
}

std::vector<RecordedItem> Workspace::chosenItems() const {
    const Page* page = pane().current();
    return page != nullptr && page->chosen ? page->chosen() : std::vector<RecordedItem>{};
}

void Workspace::openPart(const std::string& name) {
    if (qobject_cast<BaseView*>(current()) == nullptr && follower(pane()) >= 0)
        pane().choose(follower(pane()));
    if (auto* view = qobject_cast<BaseView*>(current())) view->openPart(name);
}

void Workspace::closeTab() { pane().close(pane().chosen()); }

void Workspace::remember(std::size_t index, int tab) {
    closed_.push_back({index, savedPage(panes_[index]->page(tab))});
    if (closed_.size() > mostClosed) closed_.erase(closed_.begin());
}

void Workspace::reopenTab() {
    if (closed_.empty()) return;
    const Closed last = std::move(closed_.back());
    closed_.pop_back();
    active_ = last.pane;
    const int open = isOpen(pane(), last.page);
    if (open < 0) return addPages(pane(), {last.page}, false);
    if (last.page[key("pinned")].toBool()) pane().setPinned(open, true);
    pane().choose(open);
}

// Of kinds with one tab it is that one, whatever it shows.
int Workspace::isOpen(const Pane& pane, const QJsonObject& saved) const {
    const QString kind = saved[key("kind")].toString();
    if (kind == key("simplex")) {
        const QString path = saved[key("state")].toObject()[key("path")].toString();
        return showing(pane, path.toStdString());
    }
    if (kind == key("plot")) return -1;
    if (kind != key(beforeKind)) return pane.find(kind);
    for (int tab = 0; tab < pane.count(); ++tab) {
        if (savedPage(pane.page(tab)) == saved) return tab;
    }
    return -1;
}

void Workspace::chooseTab(int number) {
    if (number < pane().count()) pane().choose(number);
}

QWidget* Workspace::current() const {
    const Page* page = pane().current();
    return page != nullptr ? page->widget : nullptr;
}

std::string Workspace::path() const {
    const Page* page = pane().current();
    return page != nullptr ? pathOf(*page) : std::string{};
}

UnitsOfView Workspace::units() const {
    const Page* page = pane().current();
    return page != nullptr ? page->units : UnitsOfView{};
}

bool Workspace::shows(const QString& kind) const {
    return std::ranges::any_of(panes_, [&](const Pane* each) {
        const Page* page = each->current();
        return page != nullptr && page->kind == kind;
    });
}

bool Workspace::wantsRoom() const {
    return std::ranges::any_of(panes_, [](const Pane* each) {
        const auto* view =
            each->current() ? qobject_cast<BaseView*>(each->current()->widget) : nullptr;
        return view != nullptr && view->wantsRoom();
    });
}

bool Workspace::settled() const {
    return std::ranges::all_of(findChildren<OwnView*>(),
                               [](OwnView* each) { return each->settled(); });
}

Wanted Workspace::wanted(const Frame& frame) const {
    Wanted all;
    for (const Pane* each : panes_) {
        const Page* page = each->current();
        if (page == nullptr || !page->wanted) continue;
        const Wanted wanted = page->wanted(frame);
        all.usual.insert(all.usual.end(), wanted.usual.begin(), wanted.usual.end());
        all.own.insert(all.own.end(), wanted.own.begin(), wanted.own.end());
    }
    return all;
}

void Workspace::refresh(const std::shared_ptr<const Frame>& frame) {
    if (auto* plot = qobject_cast<PlotView*>(current())) lastPlot_ = plot;
    for (const Pane* each : panes_) {
        for (int tab = 0; tab < each->count(); ++tab) {
            const Page& page = each->page(tab);
            if (page.refresh && (page.goesOn || tab == each->chosen())) page.refresh(frame);
        }
    }
    if (wantsRoom() == wantedRoom_) return;
    wantedRoom_ = !wantedRoom_;
    Q_EMIT currentChanged();
}

void Workspace::restyle() {
    for (Pane* each : panes_) each->restyle();
}

QJsonObject Workspace::saved() const {
    QJsonArray panes;
    for (const Pane* each : panes_) {
        QJsonArray pages;
        for (int tab = 0; tab < each->count(); ++tab) pages.append(savedPage(each->page(tab)));
        panes.append(QJsonObject{{key("tabs"), pages}, {key("front"), each->chosen()}});
    }
    QJsonArray sizes;
    for (const int each : sides_->sizes()) sizes.append(each);
    return {{key("panes"), panes}, {key("sizes"), sizes}, {key(overviewKind), true}};
}

// The first simplex of all is the tab that is there already, which then stands where it stood.
void Workspace::addPages(Pane& pane, const QJsonArray& pages, bool all) {
    bool taken = !all || &pane != panes_[0];
    for (const QJsonValue each : pages) {
        const QJsonObject saved = each.toObject();
        auto [page, title] =
            makePage(parts_, saved[key("kind")].toString(), saved[key("state")].toObject());
        page.pinned = saved[key("pinned")].toBool();
        if (!taken && page.kind == key("simplex")) {
            taken = true;
            Page first = pane.take(0);
            const int tab = pane.add(std::move(first), title, pane.count());
            const std::string path = pathOf(page);
            pane.page(tab).units.choose(page.units.now());
            page.widget->deleteLater();
            if (!path.empty()) follow(path);
            pane.setPinned(tab, page.pinned);
            continue;
        }
        const int at = all && !page.closable ? pane.count() : placeOf(page, pane);
        const bool plot = page.kind == key("plot");
        pane.choose(pane.add(std::move(page), plot ? freeTitle(title) : title, at));
    }
}

Workspace::~Workspace() {
    qApp->disconnect(this);  // a menu that is open goes with it, and gives the keyboard back
    parts_.session.recorder().record(this, {});
}

// What was recorded goes on for a while: the next layout may have it as well, or this one may come
// back.
void Workspace::keepRecording() {
    Recorder& recorder = parts_.session.recorder();
    recorder.record(this, recorder.wanted());
    release_.start(keptFor);
}

void Workspace::restore(const QJsonObject& saved) {
    const QJsonArray panes = saved[key("panes")].toArray();
    keepRecording();
    clear();
    for (std::size_t i = 0; i < panes_.size(); ++i) {
        const QJsonObject pane = panes.at(static_cast<int>(i)).toObject();
        active_ = i;
        addPages(*panes_[i], pane[key("tabs")].toArray(), true);
        panes_[i]->choose(
            std::clamp(pane[key("front")].toInt(), 0, std::max(panes_[i]->count() - 1, 0)));
    }
    if (!saved.contains(key(overviewKind))) addOverview();  // an earlier build saved it
    active_ = 0;
    hideEmpty();
    QList<int> sizes;
    for (const QJsonValue each : saved[key("sizes")].toArray()) sizes << each.toInt();
    if (sizes.size() == 2) sides_->setSizes(sizes);
    Q_EMIT currentChanged();
}

}  // namespace cortex::gui
