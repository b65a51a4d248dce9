// SPDX-License-Identifier: Apache-2.0
#include "views/system_tree.hpp"

#include "common/role_meaning.hpp"
#include "style/look.hpp"
#include "views/tree_rows.hpp"
#include "widgets/filter_keys.hpp"
#include "widgets/row_note.hpp"
#include "widgets/rows.hpp"
#include "widgets/text_label.hpp"

#include <QHBoxLayout>
#include <QKeyEvent>
#include <QLineEdit>
#include <QVBoxLayout>
#include <utility>

namespace cortex::gui {

SystemTree::SystemTree(QWidget* parent)
    : QWidget{parent},
      tree_{makeRows()},
      openness_{*tree_, model_},
      filter_{new QLineEdit},
      head_{new QHBoxLayout},
      count_{new TextLabel{TextSize::Text, false, &Tokens::ink2}},
      trouble_{new RowNote{*tree_}} {
    auto* title = new TextLabel{TextSize::Text, true};
    title->show(tr("Simplexes"));
    title->explain(tr(common::simplexMeaning));
    title->keepWhole();  // the count gives way
    head_->setContentsMargins(Look::units(3), Look::units(2), Look::units(3), 0);
    head_->setSpacing(Look::units(3));
    head_->addWidget(title);
    head_->addStretch(1);
    head_->addWidget(count_);

    filter_->setPlaceholderText(tr("Filter: name, is:AxisConcept, fault"));
    filter_->setAccessibleName(tr("Filter"));
    filter_->setClearButtonEnabled(true);
    filter_->setTextMargins(Look::units(1), 0, Look::units(1), 0);
    setAutoFillBackground(true);
    auto* box = new QVBoxLayout;
    box->setContentsMargins(Look::units(3), Look::units(2), Look::units(3), Look::units(2));
    box->addWidget(filter_);
    setFocusProxy(tree_);

    setUpRows(*tree_);
    tree_->setHeaderHidden(true);
    tree_->setAccessibleName(tr("Simplexes"));
    tree_->setExpandsOnDoubleClick(false);
    tree_->setContextMenuPolicy(Qt::CustomContextMenu);
    connect(tree_, &QTreeView::customContextMenuRequested, this, &SystemTree::askMenu);

    auto* rows = new QVBoxLayout{this};
    rows->setContentsMargins(0, 0, 0, 0);
    rows->setSpacing(0);
    rows->addLayout(head_);
    rows->addLayout(box);
    rows->addWidget(tree_, 1);

    connect(this, &SystemTree::chosen, this, &SystemTree::left);
    connect(this, &SystemTree::pinned, this, &SystemTree::left);
    connect(this, &SystemTree::entered, this, &SystemTree::left);
    connect(filter_, &QLineEdit::textChanged, this, &SystemTree::useFilter);
    joinFilter(*filter_, *tree_, [this](FilterKey key) { leaveFilter(key); });
    for (const auto opened : {&QTreeView::expanded, &QTreeView::collapsed}) {
        connect(tree_, opened, this, [this] {
            if (tree_->acts()) Q_EMIT changed();
        });
    }
    // Also the row that is chosen already, which may be behind another tab.
    connect(tree_, &QTreeView::clicked, this, [this](const QModelIndex& index) {
        if (model_.place(index) && model_.path(index) == current_) Q_EMIT chosen(current_);
    });
    connect(tree_, &QTreeView::activated, this, [this](const QModelIndex& index) {
        if (!model_.place(index)) return;
        coversViews() ? Q_EMIT entered(model_.path(index)) : Q_EMIT pinned(model_.path(index));
    });
}

void SystemTree::addLeft(QWidget& back) {
    head_->insertWidget(0, &back);
    back_ = &back;
}

// Then a step of a key opens nothing, as what is opened takes the place of the tree.
bool SystemTree::coversViews() const { return back_ != nullptr && back_->isVisible(); }

void SystemTree::keyPressEvent(QKeyEvent* event) {
    if (event->key() != Qt::Key_Escape) return QWidget::keyPressEvent(event);
    if (filter_->hasFocus() && !filter_->text().isEmpty()) return filter_->clear();
    Q_EMIT left();
}

TreeRows* SystemTree::makeRows() {
    auto* rows = new TreeRows{model_};
    rows->setModel(&model_);
    connect(rows->selectionModel(), &QItemSelectionModel::currentChanged, this,
            [this, rows](const QModelIndex& now) {
                if (!rows->acts() || !now.isValid()) return;
                current_ = model_.path(now);
                if (!model_.place(now) || rows->presses() || coversViews()) return;
                Q_EMIT chosen(std::string{current_});
            });
    return rows;
}

// By a key the menu is that of the current row.
void SystemTree::askMenu(const QPoint& at) {
    QModelIndex index = tree_->indexAt(at);
    if (!index.isValid()) index = tree_->currentIndex();
    if (!index.isValid()) return;
    Q_EMIT menuWanted(model_.path(index), tree_->viewport()->mapToGlobal(at));
}

void SystemTree::refresh(std::shared_ptr<const Frame> frame) {
    tree_->keepPlace([&] {
        model_.update(std::move(frame));
        if (!current_.empty()) keepCurrent();
        if (!wanted_.empty()) choose(std::exchange(wanted_, {}));
    });
    tellTrouble();
    tellCount();
}

// What a person made the current row stays it, and no other becomes it, while rows come and go.
void SystemTree::keepCurrent() {
    const QModelIndex index = model_.indexOf(current_);
    if (index == tree_->currentIndex()) return;
    tree_->setAutoScroll(false);  // that would open what is above it
    if (index.isValid()) {
        tree_->setCurrentIndex(index);
    } else {
        tree_->selectionModel()->clear();
    }
    tree_->setAutoScroll(true);
}

// Down: to the row that is chosen, where it is shown, else to the first. Enter: the first simplex,
// not only a part of its path.
void SystemTree::leaveFilter(FilterKey key) {
    const QModelIndex first = model_.index(0, 0);
    if (key == FilterKey::Down) {
        tree_->setFocus(Qt::TabFocusReason);
        const QModelIndex chosen = current_.empty() ? QModelIndex{} : model_.indexOf(current_);
        if (!chosen.isValid()) return tree_->goTo(first);
        openAbove(chosen);
        return tree_->scrollTo(chosen);
    }
    QModelIndex row = first;
    while (row.isValid() && !model_.place(row)) row = tree_->indexBelow(row);
    if (!row.isValid()) return;
    current_ = model_.path(row);
    tree_->setCurrentIndex(row);
    Q_EMIT key == FilterKey::Enter ? entered(std::string{current_}) : pinned(std::string{current_});
}

void SystemTree::choose(const std::string& path) {
    const QModelIndex index = model_.indexOf(path);
    if (!index.isValid()) {
        wanted_ = path;
        return;
    }
    openAbove(index);
    current_ = path;
    tree_->setCurrentIndex(index);
    tree_->scrollTo(index);
}

void SystemTree::openAbove(const QModelIndex& index) {
    for (QModelIndex above = index.parent(); above.isValid(); above = above.parent()) {
        tree_->expand(above);
    }
}

std::string SystemTree::meant(const std::string& shown) const {
    const QModelIndex index = current_.empty() ? QModelIndex{} : model_.indexOf(current_);
    if (!index.isValid()) return shown;
    return shown.empty() || !model_.place(index) ? current_ : shown;
}

void SystemTree::filter(const QString& text) { filter_->setText(text); }

void SystemTree::focusFilter() {
    filter_->setFocus(Qt::ShortcutFocusReason);
    filter_->selectAll();
}

void SystemTree::useFilter() {
    tree_->forgetPlace();
    Query query{filter_->text()};
    filtered_ = !query.empty();
    model_.setFilter(std::move(query));
    openness_.showAll(filtered_);
    if (!current_.empty()) {
        keepCurrent();
        openAbove(model_.indexOf(current_));
        if (!filtered_) tree_->scrollTo(tree_->currentIndex());
    }
    tellTrouble();
    tellCount();
}

// Of all agents, or how many of those the filter shows.
void SystemTree::tellCount() {
    const auto agents = static_cast<int>(model_.frame().agents.size());
    count_->show(filtered_ ? tr("%1 of %2 shown").arg(model_.matching()).arg(model_.simplexes())
                           : tr("%1 in %n agents", nullptr, agents).arg(model_.simplexes()));
}

// What is wrong with the filter, or that it finds nothing, for as long as that is true.
void SystemTree::tellTrouble() {
    QString trouble = model_.filter().troubleIn(model_.frame());
    if (trouble.isEmpty() && filtered_ && model_.simplexes() > 0 && model_.rowCount() == 0) {
        trouble = tr("Nothing matches \"%1\".").arg(filter_->text());
    }
    trouble_->show(trouble);
}

}  // namespace cortex::gui
