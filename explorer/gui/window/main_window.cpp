// SPDX-License-Identifier: Apache-2.0
#include "window/main_window.hpp"

#include "model/permission.hpp"
#include "style/glyphs.hpp"
#include "style/look.hpp"
#include "views/agent_table.hpp"
#include "views/base_view.hpp"
#include "views/event_list.hpp"
#include "views/event_view.hpp"
#include "views/graph_view.hpp"
#include "views/system_tree.hpp"
#include "widgets/text_label.hpp"
#include "window/control_bar.hpp"
#include "window/status_bar.hpp"
#include "window/stop_button.hpp"

#include <QAction>
#include <QActionGroup>
#include <QApplication>
#include <QCloseEvent>
#include <QHBoxLayout>
#include <QMenu>
#include <QMessageBox>
#include <QPainter>
#include <QPushButton>
#include <QResizeEvent>
#include <QScopedValueRollback>
#include <QShortcut>
#include <QSplitter>
#include <QStackedWidget>
#include <QTabBar>
#include <QVBoxLayout>
#include <algorithm>
#include <array>

namespace cortex::explorer {

namespace {

constexpr int framePeriod = 33;  // ms
constexpr std::array scales{1.0, 1.25, 1.5};
constexpr int controlLine = 3;  // px, along the top edge
constexpr int fixedTabs = 3;    // at the end: graph, agents and events

}  // namespace

MainWindow::MainWindow(Session& session, QWidget* parent)
    : QWidget{parent},
      session_{session},
      commands_{session},
      tree_{new SystemTree},
      tabs_{new QTabBar},
      views_{new QStackedWidget},
      graph_{new GraphView},
      agents_{new AgentTable},
      eventView_{new EventView{eventFilter_}},
      eventList_{new EventList{eventFilter_}},
      across_{new QSplitter{Qt::Horizontal}},
      down_{new QSplitter{Qt::Vertical}},
      status_{new StatusBar},
      menu_{new QPushButton{tr("Menu")}},
      title_{new TextLabel{TextSize::Value, true}},
      stop_{new StopButton{session}},
      control_{new ControlBar{session}},
      arrangement_{*across_, *down_} {
    setWindowTitle(tr("CorteX Explorer"));
    tabs_->setExpanding(false);
    tabs_->setDrawBase(false);
    tabs_->setTabsClosable(false);
    tabs_->setElideMode(Qt::ElideNone);
    tabs_->setUsesScrollButtons(true);
    tabs_->setAccessibleName(tr("Views"));

    auto* workspace = new QWidget;
    auto* column = new QVBoxLayout{workspace};
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(0);
    auto* top = new QHBoxLayout;
    top->setSpacing(Look::units(2));
    top->addWidget(&arrangement_.treeButton());
    top->addWidget(tabs_, 1);
    column->addLayout(top);
    column->addWidget(views_, 1);

    down_->addWidget(workspace);
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
    rows->addWidget(makeBar());
    rows->addWidget(control_->notice());
    rows->addWidget(across_, 1);
    rows->addWidget(status_);

    addView({}, false);
    views_->addWidget(graph_);
    tabs_->addTab(tr("System"));
    views_->addWidget(agents_);
    tabs_->addTab(tr("Agents"));
    views_->addWidget(eventView_);
    tabs_->addTab(tr("Events"));
    connect(tabs_, &QTabBar::currentChanged, views_, &QStackedWidget::setCurrentIndex);
    connect(tabs_, &QTabBar::currentChanged, this, &MainWindow::showStrip);
    connect(tree_, &SystemTree::chosen, this, &MainWindow::open);
    connect(tree_, &SystemTree::pinned, this, &MainWindow::openTab);
    connect(tree_, &SystemTree::chosen, this, [this] { arrangement_.leaveTree(); });
    connect(tree_, &SystemTree::pinned, this, [this] { arrangement_.leaveTree(); });
    connect(eventList_, &EventList::opened, this, &MainWindow::open);
    connect(eventView_, &EventView::opened, this, &MainWindow::open);
    connect(graph_, &GraphView::opened, this, &MainWindow::open);
    connect(status_, &StatusBar::nextWanted, this,
            [this](Abnormal::Kind kind) { openAbnormal(false, kind); });
    connect(control_, &ControlBar::changed, this, qOverload<>(&QWidget::update));
    addKeys();
    ManualView::helpOf(*tree_, tr("Finding something"));
    ManualView::helpOf(*control_, tr("Control and commands"));
    ManualView::helpOf(*stop_, tr("Stop"));

    setMinimumSize(800, 600);
    resize(1280, 800);
    session_.view({"/"});  // states and qualities of all are in the tree
    connect(&timer_, &QTimer::timeout, this, &MainWindow::refresh);
    timer_.start(framePeriod);
}

QWidget* MainWindow::makeBar() {
    auto* bar = new QWidget;
    auto* row = new QHBoxLayout{bar};
    barRow_ = row;
    menu_->setAccessibleName(tr("Menu"));
    auto* entries = new QMenu{menu_};
    entries->addAction(tr("Next theme"), this, [this] { setTheme(1); });
    for (const double scale : scales) {
        entries->addAction(tr("Text %1 %").arg(scale * 100), this,
                           [this, scale] { setScale(scale); });
    }
    addRates(*entries->addMenu(tr("Values")));
    entries->addSeparator();
    entries->addAction(tr("Hand over control…"), this, [this] { control_->chooseHandOver(); });
    entries->addAction(tr("Manual"), this, &MainWindow::openManual);
    entries->addAction(tr("Join again"), this, [this] { session_.joinAgain(); });
    entries->addAction(tr("Quit"), this, &QWidget::close);
    menu_->setMenu(entries);
    row->addWidget(menu_);
    title_->show(tr("CorteX Explorer"));
    row->addWidget(title_);
    row->addStretch(1);
    auto* stopped = new TextLabel{TextSize::Text};
    connect(stop_, &StopButton::told, stopped, qOverload<const QString&>(&TextLabel::show));
    row->addWidget(stopped);
    row->addWidget(control_);
    row->addWidget(stop_);
    return bar;
}

// How often values are taken; the tick follows the session, which the command line may have set.
void MainWindow::addRates(QMenu& menu) {
    auto* choices = new QActionGroup{&menu};
    for (const std::uint32_t rate : Session::rates) {
        QAction* choice =
            menu.addAction(rate == 0 ? tr("In every cycle") : tr("%1 times a second").arg(rate));
        choice->setCheckable(true);
        choices->addAction(choice);
        connect(choice, &QAction::triggered, this, [this, rate] { session_.setRate(rate); });
        connect(&menu, &QMenu::aboutToShow, choice,
                [this, choice, rate] { choice->setChecked(session_.frame()->rate == rate); });
    }
}

void MainWindow::addKeys() {
    const auto key = [this](const char* keys, auto&& action) {
        connect(new QShortcut{QKeySequence{QLatin1String{keys}}, this}, &QShortcut::activated, this,
                action);
    };
    key("Ctrl+F", [this] {
        if (current() == eventView_) return eventView_->focusFilter();
        arrangement_.showTree();
        tree_->focusFilter();
    });
    key("Ctrl+B", [this] { arrangement_.toggleTree(); });
    key("Ctrl+E", [this] {
        strip_ = !strip_;
        showStrip();
    });
    key("Ctrl+W", [this] { closeTab(tabs_->currentIndex()); });
    key("Ctrl+Shift+L", [this] { setTheme(1); });
    key("Ctrl+0", [this] { setScale(1); });
    key("Ctrl++", [this] { setScale(std::min(Look::scale() + 0.25, 1.5)); });
    key("Ctrl+-", [this] { setScale(std::max(Look::scale() - 0.25, 1.0)); });
    key("Ctrl+T", [this] { control_->choose(); });
    key("Ctrl+Shift+T", [this] { control_->release(); });
    key("F1", [this] { openManual(); });
    key("F8", [this] { openAbnormal(false); });
    key("Shift+F8", [this] { openAbnormal(true); });
    key("F11", [this] { setWindowState(windowState() ^ Qt::WindowFullScreen); });
    for (int i = 1; i <= 9; ++i) {
        const std::string keys = "Ctrl+" + std::to_string(i);
        key(keys.c_str(), [this, i] {
            if (i <= tabs_->count()) tabs_->setCurrentIndex(i - 1);
        });
    }
}

BaseView* MainWindow::addView(const std::string& path, bool closable) {
    auto* view = new BaseView{commands_, times_};
    view->show(path);
    connect(view, &BaseView::opened, this, &MainWindow::open);
    connect(view, &BaseView::dismissed, this,
            [this](const std::string& agent) { session_.dismiss(agent); });
    // Views stand before the graph, the agents and the events.
    const int at = closable ? tabs_->count() - fixedTabs : 0;
    views_->insertWidget(at, view);
    tabs_->insertTab(at, path.empty() ? tr("Simplex") : QString::fromStdString(path));
    return view;
}

QWidget* MainWindow::current() const { return views_->currentWidget(); }

void MainWindow::open(const std::string& path) {
    auto* view = qobject_cast<BaseView*>(views_->widget(0));
    tabs_->setCurrentIndex(0);
    tabs_->setTabText(0, QString::fromStdString(path));
    if (view->path() != path) view->show(path);
    tree_->choose(path);
    refresh();
}

void MainWindow::openTab(const std::string& path) {
    addView(path, true);
    tabs_->setCurrentIndex(tabs_->count() - fixedTabs - 1);
    refresh();
}

void MainWindow::openAgents() { tabs_->setCurrentIndex(tabs_->count() - fixedTabs + 1); }

void MainWindow::openEvents() { tabs_->setCurrentIndex(tabs_->count() - 1); }

void MainWindow::showStrip() { eventList_->setVisible(strip_ && current() != eventView_); }

void MainWindow::openManual() {
    const QString section = ManualView::sectionOf(QApplication::focusWidget());
    if (!manual_) {
        manual_ = new ManualView;
        const int at = tabs_->count() - fixedTabs;
        views_->insertWidget(at, manual_);
        tabs_->insertTab(at, tr("Manual"));
    }
    tabs_->setCurrentIndex(views_->indexOf(manual_));
    manual_->openAt(section.isEmpty() ? tr("What it shows") : section);
    manual_->setFocus();
}

// The next one that is in Fault, outside of its limits or lost, or the one before.
void MainWindow::openAbnormal(bool back, std::optional<Abnormal::Kind> kind) {
    const auto* shown = qobject_cast<BaseView*>(current());
    const std::string next =
        abnormal_.next(shown != nullptr ? shown->path() : std::string{}, back, kind);
    if (!next.empty()) open(next);
}

void MainWindow::openGraph() { tabs_->setCurrentIndex(tabs_->count() - fixedTabs); }

void MainWindow::openPart(const std::string& name) {
    if (auto* view = qobject_cast<BaseView*>(current())) view->openPart(name);
}

// The first tab and the last ones stay.
void MainWindow::closeTab(int tab) {
    if (tab <= 0 || tab >= tabs_->count() - fixedTabs) return;
    QWidget* view = views_->widget(tab);
    views_->removeWidget(view);
    tabs_->removeTab(tab);
    view->deleteLater();
}

// A view may open another one while it is refreshed; that is seen in the next frame.
void MainWindow::refresh() {
    if (refreshing_) return;
    const QScopedValueRollback refreshing{refreshing_, true};
    session_.isAlive();
    const auto frame = session_.frame();
    auto events = session_.takeEvents();
    times_.add(events);
    events_.add(std::move(events));
    tree_->refresh(frame);
    abnormal_.update(*frame);
    status_->refresh(*frame, abnormal_);
    const auto outcomes = session_.takeOutcomes();
    commands_.deliver(outcomes);
    stop_->refresh(*frame, outcomes);
    const auto* shown = qobject_cast<BaseView*>(current());
    control_->refresh(frame, shown != nullptr ? shown->path() : std::string{});
    if (auto* view = qobject_cast<BaseView*>(current())) view->refresh(frame);
    if (current() == graph_) graph_->refresh(frame);
    if (current() == agents_) agents_->refresh(*frame);
    if (current() == eventView_) eventView_->refresh();
}

bool MainWindow::ready() const {
    const auto frame = session_.frame();
    if (!frame->joined || frame->agents.empty()) return false;
    return std::ranges::all_of(frame->agents, [](const AgentFrame& agent) {
        return agent.lost() || (agent.structure && agent.status.missing == 0 && agent.came(0));
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

void MainWindow::restyle() {
    for (QWidget* each : findChildren<QWidget*>()) each->updateGeometry();
    if (manual_) manual_->restyle();
    update();
}

void MainWindow::paintEvent(QPaintEvent* /*event*/) {
    QPainter painter{this};
    painter.fillRect(rect(), Look::colours().window);
    if (control_->holds()) painter.fillRect(0, 0, width(), controlLine, Look::colours().accent);
}

// Nothing but what the user asked for ends control: the end of the program releases it.
void MainWindow::closeEvent(QCloseEvent* event) {
    if (!control_->holds() || leaves_) {
        event->accept();
        return;
    }
    event->ignore();
    auto* question = new QMessageBox{this};
    question->setAttribute(Qt::WA_DeleteOnClose);
    question->setText(tr("Release %1 and quit?").arg(scopeText(control_->prefix())));
    question->setInformativeText(tr("What is Active stays so."));
    auto* quit = question->addButton(tr("Quit"), QMessageBox::AcceptRole);
    question->setDefaultButton(question->addButton(tr("Stay"), QMessageBox::RejectRole));
    connect(quit, &QAbstractButton::clicked, this, [this] {
        leaves_ = true;
        close();
    });
    question->open();
}

// Where it is narrow, the tree takes the place of the views until something is chosen in it.
void MainWindow::resizeEvent(QResizeEvent* event) {
    QWidget::resizeEvent(event);
    arrange();
}

void MainWindow::changeEvent(QEvent* event) {
    QWidget::changeEvent(event);
    const bool sized = event->type() == QEvent::ApplicationFontChange ||
                       event->type() == QEvent::StyleChange || event->type() == QEvent::FontChange;
    if (sized && barRow_ != nullptr) arrange();
}

// The bar gives way before the lease or Stop would be cut.
void MainWindow::arrange() {
    if (arrangement_.fit(size())) strip_ = !arrangement_.isNarrow();
    showStrip();
    const bool narrow = arrangement_.isNarrow();
    const int side = Look::units(narrow ? 1.5 : 3), size = Look::units(4);
    barRow_->setContentsMargins(side, Look::units(2), side, Look::units(2));
    barRow_->setSpacing(side);
    title_->setVisible(!narrow);
    menu_->setText(narrow ? QString{} : tr("Menu"));
    menu_->setIconSize({size, size});
    menu_->setIcon(narrow ? icon(Glyph::Menu, Look::colours().ink, size) : QIcon{});
    control_->setNarrow(narrow);
}

}  // namespace cortex::explorer
