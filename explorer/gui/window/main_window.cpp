// SPDX-License-Identifier: Apache-2.0
#include "window/main_window.hpp"

#include "model/permission.hpp"
#include "model/plotted_items.hpp"
#include "model/shown_time.hpp"
#include "session/utc_now.hpp"
#include "style/look.hpp"
#include "views/event_list.hpp"
#include "views/event_view.hpp"
#include "views/system_tree.hpp"
#include "widgets/focus_edge.hpp"
#include "window/control_bar.hpp"
#include "window/control_notice.hpp"
#include "window/find_panel.hpp"
#include "window/layout_keeper.hpp"
#include "window/status_bar.hpp"
#include "window/stop_button.hpp"
#include "window/top_bar.hpp"
#include "window/tree_menu.hpp"
#include "window/window_menu.hpp"
#include "window/window_size.hpp"
#include "window/workspace.hpp"

#include <QApplication>
#include <QCloseEvent>
#include <QMenu>
#include <QPainter>
#include <QPushButton>
#include <QResizeEvent>
#include <QScopedValueRollback>
#include <QShortcut>
#include <QSplitter>
#include <QTabBar>
#include <QVBoxLayout>
#include <algorithm>
#include <utility>

namespace cortex::gui {

namespace {

constexpr int framePeriod = 33;        // ms
constexpr int controlLine = 3;         // px, along the top edge
constexpr std::uint32_t treeRate = 5;  // Hz, of what only the tree and the counters show

}  // namespace

MainWindow::MainWindow(Session& session, QWidget* parent)
    : QWidget{parent},
      session_{session},
      commands_{session},
      tree_{new SystemTree},
      workspace_{
          new Workspace{{session, commands_, host_, times_, eventFilter_, past_, abnormal_}}},
      eventList_{new EventList{eventFilter_}},
      across_{new QSplitter{Qt::Horizontal}},
      down_{new QSplitter{Qt::Vertical}},
      status_{new StatusBar},
      layout_{new LayoutKeeper{
          Layouts{},
          {[this] { return saved(); }, [this](const auto& each) { restore(each); }},
          this}},
      stop_{new StopButton{session}},
      edge_{new FocusEdge{this}},
      control_{new ControlBar{session}},
      orders_{new Orders{session, *stop_, *control_, this}},
      bar_{new TopBar{*control_, *stop_}},
      arrangement_{*across_, *down_, [this] { layout_->noteChange(); }},
      leaving_{*this, *control_, orders_->startAgain(), commands_} {
    setWindowTitle(tr("CorteX Explorer"));
    arrangement_.join(*tree_, *workspace_);
    down_->addWidget(workspace_);
    down_->addWidget(eventList_);
    down_->setStretchFactor(0, 1);
    down_->setChildrenCollapsible(false);
    across_->addWidget(tree_);
    across_->addWidget(down_);
    across_->setStretchFactor(1, 1);
    across_->setChildrenCollapsible(false);

    auto* rows = new QVBoxLayout{this};
    rows->setContentsMargins(0, controlLine, 0, 0);
    rows->setSpacing(0);
    bar_->setMenu(*makeMenu());
    rows->addWidget(bar_);
    rows->addWidget(&control_->notice().place());
    rows->addWidget(across_, 1);
    rows->addWidget(status_);
    control_->notice().lieIn(*this, {&arrangement_.treeButton(), &arrangement_.backButton()});

    connect(workspace_, &Workspace::changed, layout_, &LayoutKeeper::noteChange);
    connect(layout_, &LayoutKeeper::told, this, [this](const QString& text, bool trouble) {
        tell(text, trouble);
        if (trouble) orders_->say(text);
    });
    connect(workspace_, &Workspace::currentChanged, this, &MainWindow::showStrip);
    connect(workspace_, &Workspace::chosen, tree_, &SystemTree::choose);
    connect(tree_, &SystemTree::chosen, this, &MainWindow::choose);
    connect(tree_, &SystemTree::pinned, this, &MainWindow::openTab);
    connect(tree_, &SystemTree::changed, layout_, &LayoutKeeper::noteChange);
    connect(tree_, &SystemTree::entered, this, [this](const std::string& path) {
        choose(path);
        enter();
    });
    connect(tree_, &SystemTree::menuWanted, this, &MainWindow::openTreeMenu);
    connect(eventList_, &EventList::opened, this, &MainWindow::open);
    connect(eventList_, &EventList::beforeWanted, workspace_, &Workspace::openBefore);
    connect(status_, &StatusBar::nextWanted, this,
            [this](Abnormal::Kind kind) { openAbnormal(false, kind); });
    connect(status_, &StatusBar::agentsWanted, this,
            [this] { openKind(QStringLiteral("agents")); });
    const auto take = [this](const std::string& prefix) { control_->choose(prefix); };
    connect(&host_, &ViewHost::controlWanted, this, take);
    connect(control_, &ControlBar::changed, this, qOverload<>(&QWidget::update));
    connect(bar_, &TopBar::findWanted, this, &MainWindow::find);
    addKeys();
    const auto& [left, right] = workspace_->panes();
    regions_.set({bar_, &control_->notice(), tree_, &left->tabs(), &left->content(), &right->tabs(),
                  &right->content(), eventList_, status_});
    ManualView::helpOf(*tree_, tr("Finding something"));
    ManualView::helpOf(*control_, tr("Control and commands"));
    ManualView::helpOf(*stop_, tr("Stop"));
    ManualView::helpOf(*eventList_, tr("Events and the past"));
    setMinimumSize(800, 600);
    resize(1280, 800);
    connect(&timer_, &QTimer::timeout, this, &MainWindow::refresh);
    timer_.start(framePeriod);
}

QMenu* MainWindow::makeMenu() {
    return makeWindowMenu(
        {session_, *orders_, *control_, [this] { setTheme(1); },
         [this](double scale) { setScale(scale); }, [this](bool local) { setLocalTime(local); },
         [this] { openManual(); }, [this] { close(); }, [this] { find(); },
         [this](const QString& kind) { openKind(kind); }, [this] { split(); },
         [this] { reopenTab(); }, [this] { workspace_->newPlot({}); }, [this] { plotChosen(); },
         [this] { return workspace_->units(); }, *layout_},
        &bar_->menuButton());
}

void MainWindow::openTreeMenu(const std::string& path, const QPoint& at) {
    const TreeActions actions{
        [this](const std::string& of) { open(of); },
        [this](const std::string& of) { openTab(of); },
        [this](const std::string& of) { control_->choose(of); },
        [this](const auto& of, const auto& agent) { startAll().begin(of, agent); },
        [this](const auto& of, const auto& agent) { stop_->stop(of, agent); },
    };
    makeTreeMenu(*session_.frame(), path, actions, this)->popup(at);
}

void MainWindow::addKeys() {
    const auto key = [this](const char* keys, auto&& action) {
        connect(new QShortcut{QKeySequence{QLatin1String{keys}}, this}, &QShortcut::activated, this,
                action);
    };
    for (const char* filter : {"Ctrl+F", "/"}) {
        key(filter, [this] {
            if (auto* events = qobject_cast<EventView*>(current())) return events->focusFilter();
            arrangement_.showTree();
            tree_->focusFilter();
        });
    }
    key("Ctrl+G", [this] { plotChosen(); });
    key("Ctrl+K", [this] { find(); });
    key("Ctrl+B", [this] { arrangement_.toggleTree(); });
    key("Ctrl+E", [this] { arrangement_.toggleEvents(*workspace_); });
    key("Ctrl+W", [this] { workspace_->closeTab(); });
    key("Ctrl+Shift+W", [this] { reopenTab(); });
    key("Ctrl+\\", [this] { split(); });
    key("Ctrl+Shift+L", [this] { setTheme(1); });
    key("Ctrl+0", [this] { setScale(1); });
    key("Ctrl++", [this] { setScale(std::min(Look::scale() + 0.25, 1.5)); });
    key("Ctrl+-", [this] { setScale(std::max(Look::scale() - 0.25, 1.0)); });
    key("Ctrl+T", [this] { control_->choose(); });
    key("Ctrl+Shift+T", [this] { control_->release(); });
    key("F1", [this] { openManual(); });
    key("F6", [this] { regions_.walk(false); });
    key("Shift+F6", [this] { regions_.walk(true); });
    key("F8", [this] { openAbnormal(false); });
    key("Shift+F8", [this] { openAbnormal(true); });
    key("F11", [this] { setWindowState(windowState() ^ Qt::WindowFullScreen); });
    for (int i = 1; i <= 9; ++i) {
        const std::string keys = "Ctrl+" + std::to_string(i);
        key(keys.c_str(), [this, i] { workspace_->chooseTab(i - 1); });
    }
}

QWidget* MainWindow::current() const { return workspace_->current(); }

void MainWindow::tell(const QString& text, bool trouble) {
    comms::AgentEvent event;
    event.agent = "cortex-explorer";
    event.wallClock = utcNow();  // also before anything has come
    event.severity = trouble ? Severity::Warning : Severity::Info;
    event.kind = "message";
    event.path = "/";
    event.text = text.toStdString();
    events_.add({std::move(event)});
}

QJsonObject MainWindow::saved() const {
    return {{QStringLiteral("workspace"), workspace_->saved()},
            {QStringLiteral("window"), arrangement_.saved()},
            {QStringLiteral("rows"), tree_->openness().saved()},
            {QStringLiteral("events"), arrangement_.wantsEvents()},
            {QStringLiteral("size"), savedSize(*this)},
            {QStringLiteral("localTime"), showsLocalTime()}};
}

void MainWindow::restore(const QJsonObject& saved) {
    workspace_->restore(saved[QStringLiteral("workspace")].toObject());
    restoreSize(*this, saved[QStringLiteral("size")].toObject());
    arrangement_.restore(saved[QStringLiteral("window")].toObject(),
                         saved[QStringLiteral("events")].toBool(true));
    tree_->openness().restore(saved[QStringLiteral("rows")].toObject());
    showStrip();
    setLocalTime(saved[QStringLiteral("localTime")].toBool());
}

void MainWindow::showStrip() { arrangement_.giveWay(*workspace_); }

// A view may open another one while it is refreshed; that is seen in the next frame.
void MainWindow::refresh() {
    if (refreshing_) return;
    const QScopedValueRollback refreshing{refreshing_, true};
    session_.isAlive();
    const auto frame = session_.frame();
    auto events = session_.takeEvents();
    times_.add(events);
    commands_.hear(events, frame->control.self);
    events_.add(std::move(events));
    past_.refresh(*frame);
    tree_->refresh(frame);
    abnormal_.update(*frame);
    status_->refresh(*frame, abnormal_);
    const auto outcomes = session_.takeOutcomes();
    commands_.deliver(outcomes);
    host_.refresh();
    orders_->refresh(*frame, outcomes);
    layout_->refresh(*frame);
    control_->refresh(frame, tree_->meant(workspace_->path()));
    session_.recorder().take();
    workspace_->refresh(frame);
    Wanted wanted = workspace_->wanted(*frame);
    std::vector<comms::Viewed> others{{{"/"}, treeRate}};
    for (explorer::Watch& each : wanted.own) {
        others.push_back({std::move(each.prefixes), each.rate});
    }
    session_.view(std::move(wanted.usual), std::move(others));
    if (isVisible()) begin();
    edge_->fit();
}

bool MainWindow::ready() const {
    const auto frame = session_.frame();
    if (!frame->joined || frame->agents.empty()) return false;
    return std::ranges::all_of(frame->agents, [](const AgentFrame& agent) {
        if (agent.lost()) return true;
        const bool described = agent.structure && agent.status.missing == 0;
        return described && agent.came(0) && (agent.own() == noSimplex || agent.came(agent.own()));
    });
}

void MainWindow::setTheme(int step) {
    const auto next = (static_cast<std::size_t>(Look::theme()) + static_cast<std::size_t>(step)) %
                      allThemes.size();
    Look::apply(allThemes[next], Look::scale());
    restyle();
}

void MainWindow::setScale(double scale) {
    Look::apply(Look::theme(), scale);
    restyle();
}

void MainWindow::setLocalTime(bool wanted) {
    if (wanted == showsLocalTime()) return;
    showLocalTime(wanted);
    Q_EMIT events_.headerDataChanged(Qt::Horizontal, EventModel::Time, EventModel::Time);
    for (QWidget* each : findChildren<QWidget*>()) each->update();
    layout_->noteChange();
    refresh();
}

void MainWindow::restyle() {
    for (QWidget* each : findChildren<QWidget*>()) each->updateGeometry();
    if (manual_) manual_->restyle();
    workspace_->restyle();
    update();
}

void MainWindow::paintEvent(QPaintEvent* /*event*/) {
    QPainter painter{this};
    painter.fillRect(rect(), Look::colours().window);
    if (control_->holds()) painter.fillRect(0, 0, width(), controlLine, Look::colours().accent);
}

// Nothing but what the user asked for ends control: the end of the program releases it.
void MainWindow::closeEvent(QCloseEvent* event) {
    if (!leaving_.mayLeave([this] { close(); })) return event->ignore();
    layout_->save();
    event->accept();
}

// Where it is narrow, the tree takes the place of the views until something is chosen in it.
void MainWindow::resizeEvent(QResizeEvent* event) {
    QWidget::resizeEvent(event);
    arrange();
    if (isVisible()) layout_->noteSize();
}

bool MainWindow::focusNextPrevChild(bool next) {
    return regions_.step(!next) || QWidget::focusNextPrevChild(next);
}

void MainWindow::changeEvent(QEvent* event) {
    QWidget::changeEvent(event);
    const bool sized = event->type() == QEvent::ApplicationFontChange ||
                       event->type() == QEvent::StyleChange || event->type() == QEvent::FontChange;
    if (sized && bar_ != nullptr) arrange();
}

void MainWindow::arrange() {
    arrangement_.fit(size());
    showStrip();
    bar_->setNarrow(arrangement_.isNarrow());
    const bool low = Look::isLow(*this);
    if (std::exchange(low_, low) == low) return;
    for (QWidget* each : findChildren<QWidget*>()) each->updateGeometry();  // of other heights
}

}  // namespace cortex::gui
