// SPDX-License-Identifier: Apache-2.0
// What the window opens, and where the keyboard goes then.
#include "model/plotted_items.hpp"
#include "views/base_view.hpp"
#include "widgets/enter_key.hpp"
#include "widgets/reading_order.hpp"
#include "window/control_bar.hpp"
#include "window/find_panel.hpp"
#include "window/main_window.hpp"
#include "window/top_bar.hpp"
#include "window/workspace.hpp"

#include <QApplication>
#include <QLineEdit>
#include <QMenu>
#include <QPushButton>
#include <algorithm>
#include <string>
#include <utility>

namespace cortex::gui {

void MainWindow::open(const std::string& path) {
    workspace_->open(path);
    refresh();
}

// A view that shows the whole system may show it itself.
void MainWindow::choose(const std::string& path) {
    if (!workspace_->select(path)) open(path);
}

void MainWindow::openTab(const std::string& path) {
    workspace_->openTab(path);
    refresh();
    enter();
}

// The keyboard goes to where one works in the view in front.
void MainWindow::enter() {
    QWidget* view = current();
    if (view == nullptr) return;
    if (auto* simplex = qobject_cast<BaseView*>(view)) return simplex->enter();
    QWidget* stop = view->focusProxy() != nullptr ? view : mainStop(*view);
    if (stop == nullptr) stop = tabsOf(*view);  // a view may have nothing for keys
    if (stop != nullptr) stop->setFocus(Qt::TabFocusReason);
}

QWidget* MainWindow::tabsOf(const QWidget& view) const {
    const auto& panes = workspace_->panes();
    const auto pane =
        std::ranges::find_if(panes, [&](const Pane* each) { return each->isAncestorOf(&view); });
    return pane == panes.end() ? nullptr : &(*pane)->tabs();
}

// The keyboard begins at the tab of the view in front, and goes to its first rows once there are
// some, unless a person has moved it by then.
void MainWindow::begin() {
    QWidget* view = current();
    if (!begins_ || view == nullptr || QApplication::activePopupWidget() != nullptr) return;
    begins_ = false;
    if (focusWidget() != begin_) return;
    if (auto* simplex = qobject_cast<BaseView*>(view)) return simplex->enter();
    QWidget* stop = mainStop(*view);
    begins_ = stop == nullptr || !isTable(*stop);
    if (begins_) begin_ = stop = tabsOf(*view);
    if (stop != nullptr) stop->setFocus(Qt::OtherFocusReason);
}

void MainWindow::showEvent(QShowEvent* event) {
    QWidget::showEvent(event);
    if (testAttribute(Qt::WA_ShowWithoutActivating)) begins_ = false;
    begin();
}

void MainWindow::reopenTab() {
    workspace_->reopenTab();
    refresh();
    enter();
}

void MainWindow::openKind(const QString& kind) {
    workspace_->openKind(kind);
    refresh();
}

FindPanel* MainWindow::findPanel() const { return find_; }

void MainWindow::find() {
    if (find_) return find_->field().selectAll();
    auto actions = actionsOf(*bar_->menuButton().menu());
    std::erase_if(actions, [](const auto& each) { return each.keys == QLatin1String{"Ctrl+K"}; });
    actions.push_back({tr("Take control…"), tr("Ctrl+T"), [this] { control_->choose(); }});
    if (control_->holds()) {
        actions.push_back(
            {tr("Release control"), tr("Ctrl+Shift+T"), [this] { control_->release(); }, true});
    }
    find_ = openFindPanel(*session_.frame(), pageKinds(), actions, bar_->findButton());
    connect(find_, &FindPanel::chosen, this,
            [this, actions = std::move(actions)](const Found& found, bool beside) {
                if (found.kind != FoundKind::Action) return openFound(found, beside);
                actions[std::stoul(found.path)].run();
            });
}

void MainWindow::openFound(const Found& found, bool beside) {
    if (found.kind == FoundKind::View) {
        openKind(QString::fromStdString(found.path));
        return enter();
    }
    if (found.kind == FoundKind::Item && beside) {
        const auto items = plottedItems(*session_.frame(), found.path, found.name);
        return items.empty() ? tell(tr("It is not there any more."), false) : openPlot(items);
    }
    beside ? workspace_->openTab(found.path, true) : workspace_->open(found.path);
    refresh();
    auto* view = qobject_cast<BaseView*>(current());
    if (view == nullptr) return;
    view->enter(found.kind == FoundKind::Item      ? "data"
                : found.kind == FoundKind::Command ? "commands"
                                                   : "",
                found.name);
}

void MainWindow::openManual() {
    const QString section = ManualView::sectionOf(QApplication::focusWidget());
    manual_ = qobject_cast<ManualView*>(workspace_->openKind(QStringLiteral("manual")));
    if (!manual_) return;
    manual_->openAt(section.isEmpty() ? tr("What it shows") : section);
    manual_->setFocus();
}

// The next one that is in Fault, outside of its limits or lost, or the one before.
void MainWindow::openAbnormal(bool back, std::optional<Abnormal::Kind> kind) {
    const std::string next = abnormal_.next(workspace_->path(), back, kind);
    if (!next.empty()) open(next);
}

void MainWindow::openPlot(const std::vector<RecordedItem>& items) {
    workspace_->openPlot(items);
    refresh();
}

void MainWindow::plotChosen() {
    const auto items = workspace_->chosenItems();
    if (items.empty()) return tell(tr("Nothing is chosen that can be plotted."), false);
    openPlot(items);
}

void MainWindow::split() {
    workspace_->split();
    refresh();
    enter();
}

void MainWindow::keyPressEvent(QKeyEvent* event) {
    if (!pressFocused(*event, *this)) QWidget::keyPressEvent(event);
}

void MainWindow::openPart(const std::string& name) { workspace_->openPart(name); }

}  // namespace cortex::gui
