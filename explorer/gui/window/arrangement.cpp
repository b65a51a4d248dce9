// SPDX-License-Identifier: Apache-2.0
#include "window/arrangement.hpp"

#include "style/look.hpp"
#include "views/system_tree.hpp"
#include "widgets/low_buttons.hpp"
#include "window/pane.hpp"
#include "window/workspace.hpp"

#include <QApplication>
#include <QJsonArray>
#include <QPushButton>
#include <QSplitter>
#include <algorithm>
#include <utility>

namespace cortex::gui {

namespace {

// 1024×700 at 100 %.
bool isTooSmall(QSize window) {
    return window.width() < Look::units(256) || window.height() < Look::units(175);
}

QString arranged(const char* name) { return QLatin1String{name}; }

QString eventsKind() { return QStringLiteral("events"); }

QString buttonWords(const char* text) { return QCoreApplication::translate("Arrangement", text); }

}  // namespace

Arrangement::Arrangement(QSplitter& across, QSplitter& down, std::function<void()> changed)
    : across_{across},
      down_{down},
      tree_{across, 0, 76},
      events_{down, 1, 25},
      changed_{std::move(changed)},
      treeButton_{new QPushButton{buttonWords("Tree ▸")}},
      backButton_{new QPushButton{buttonWords("◂ Back")}} {
    treeButton_->setToolTip(buttonWords("All simplexes (Ctrl+B)"));
    backButton_->setToolTip(buttonWords("Back to the views (Ctrl+B, Esc)"));
    for (QPushButton* each : {treeButton_, backButton_}) {
        each->hide();
        QObject::connect(each, &QPushButton::clicked, each, [this] { toggleTree(); });
    }
    for (const QSplitter* each : {&across_, &down_}) {
        QObject::connect(each, &QSplitter::splitterMoved, treeButton_, [this] {
            noteSizes();
            changed_();
        });
    }
}

void Arrangement::join(SystemTree& tree, Workspace& views) {
    const auto leave = [this] { leaveTree(); };
    views.panes()[0]->addLeft(*treeButton_);
    tree.addLeft(*backButton_);
    QObject::connect(&tree, &SystemTree::left, backButton_, leave);
    QObject::connect(&views, &Workspace::chosen, backButton_, leave);
    for (Pane* each : views.panes())
        QObject::connect(each, &Pane::currentChanged, backButton_, leave);
}

QWidget& Arrangement::Part::widget() const { return *splitter.widget(index); }

// So small that nothing in it can be read is taken for unknown: a hidden part was saved so.
int Arrangement::Part::sizeOr(int pixels) const { return size < pixels * 2 / 5 ? pixels : size; }

bool Arrangement::fit(QSize window) {
    lowerWhereLow({treeButton_, backButton_});
    const bool narrow = isTooSmall(window);
    if (fitted_ && narrow == narrow_) return false;
    if (fitted_) noteSizes();
    narrow_ = narrow;
    fitted_ = true;
    treeButton_->setVisible(narrow);
    backButton_->hide();
    down_.show();
    tree_.widget().setVisible(!narrow && tree_.shown);
    events_.widget().setVisible(seesEvents());
    if (!narrow) {
        place(tree_, window.width());
        place(events_, window.height());
    }
    return true;
}

void Arrangement::place(const Part& part, int whole) {
    const int size = part.sizeOr(Look::units(part.usual));
    QList<int> sizes{size, std::max(whole - size, size)};
    if (part.index == 1) sizes.swapItemsAt(0, 1);
    part.splitter.setSizes(sizes);
}

void Arrangement::noteSizes() {
    if (narrow_ || !fitted_) return;
    for (Part* each : {&tree_, &events_}) {
        if (!each->widget().isHidden()) each->size = each->splitter.sizes()[each->index];
    }
}

// What was hidden from the start has no size of its own: it gets its last one.
void Arrangement::show(Part& part, bool shown) {
    if (part.widget().isHidden() != shown) return;
    noteSizes();
    part.widget().setVisible(shown);
    const int whole = part.splitter.orientation() == Qt::Horizontal ? part.splitter.width()
                                                                    : part.splitter.height();
    if (shown && fitted_ && !narrow_) place(part, whole);
}

QJsonObject Arrangement::saved() const {
    const auto sizesOf = [this](const Part& part) {
        const bool isSeen = fitted_ && !narrow_ && !part.widget().isHidden();
        QList<int> sizes = part.splitter.sizes();
        if (!isSeen) sizes[part.index] = part.size;
        return QJsonArray{sizes[0], sizes[1]};
    };
    return {{arranged("across"), sizesOf(tree_)},
            {arranged("down"), sizesOf(events_)},
            {arranged("tree"), tree_.shown}};
}

void Arrangement::restore(const QJsonObject& saved, bool wantsEvents) {
    tree_.size = saved[arranged("across")].toArray()[0].toInt();
    events_.size = saved[arranged("down")].toArray()[1].toInt();
    tree_.shown = saved[arranged("tree")].toBool(true);
    events_.shown = wantsEvents;
    if (!fitted_ || narrow_) return;
    tree_.widget().setVisible(tree_.shown);
    events_.widget().setVisible(seesEvents());
    place(tree_, across_.width());
    place(events_, down_.height());
}

void Arrangement::toggleTree() {
    const bool shows = tree_.widget().isHidden();
    if (narrow_) return cover(shows);
    show(tree_, shows);
    tree_.shown = shows;
    changed_();
}

// The keyboard goes with it, and comes back to where it was.
void Arrangement::cover(bool covers) {
    const QWidget* now = QApplication::focusWidget();
    const bool inTree = now != nullptr && tree_.widget().isAncestorOf(now);
    if (covers) focused_ = down_.isAncestorOf(now) ? QApplication::focusWidget() : nullptr;
    tree_.widget().setVisible(covers);
    down_.setVisible(!covers);
    backButton_->setVisible(covers);
    if (covers) {
        tree_.widget().setFocus();
    } else if (inTree) {
        QWidget* back = focused_ && focused_->isVisible() ? focused_.data() : treeButton_;
        back->setFocus();
    }
}

void Arrangement::showTree() {
    if (tree_.widget().isHidden()) toggleTree();
}

void Arrangement::leaveTree() {
    if (narrow_ && !tree_.widget().isHidden()) cover(false);
}

// In a narrow window they have a tab, and the same key leads back to what was in front of it.
void Arrangement::toggleEvents(Workspace& views) {
    if (narrow_) {
        const bool covered = !tree_.widget().isHidden();
        leaveTree();
        for (Pane* each : views.panes()) {
            const Page* page = each->current();
            if (page == nullptr || page->kind != eventsKind()) continue;
            if (!covered) each->goBack();
            return;
        }
        views.openKind(eventsKind());
        return;
    }
    events_.shown = roomMade_ || !events_.shown;
    roomMade_ = false;
    showEvents();
    changed_();
}

void Arrangement::giveWay(const Workspace& views) {
    eventsElsewhere_ = views.shows(eventsKind());
    const bool room = views.wantsRoom();
    if (room != roomWanted_) roomMade_ = room;
    roomWanted_ = room;
    showEvents();
}

bool Arrangement::seesEvents() const {
    return !narrow_ && events_.shown && !eventsElsewhere_ && !roomMade_;
}

void Arrangement::showEvents() { show(events_, seesEvents()); }

}  // namespace cortex::gui
