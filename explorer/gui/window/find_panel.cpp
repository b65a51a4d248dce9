// SPDX-License-Identifier: Apache-2.0
#include "window/find_panel.hpp"

#include "style/look.hpp"
#include "widgets/rows.hpp"
#include "widgets/text_label.hpp"

#include <QHeaderView>
#include <QKeyEvent>
#include <QLineEdit>
#include <QTreeWidget>
#include <QVBoxLayout>
#include <algorithm>
#include <utility>

namespace cortex::gui {

namespace {

constexpr std::size_t mostShown = 200;

QString kindText(FoundKind kind) {
    switch (kind) {
        case FoundKind::View:
            return FindPanel::tr("view");
        case FoundKind::Action:
            return FindPanel::tr("action");
        case FoundKind::Simplex:
            return FindPanel::tr("simplex");
        case FoundKind::Command:
            return FindPanel::tr("command");
        case FoundKind::Item:
            return FindPanel::tr("item");
    }
    return {};
}

// Smaller only where the screen is.
class FoundList : public QTreeWidget {
public:
    QSize sizeHint() const override { return {Look::units(150), Look::units(72)}; }
};

}  // namespace

FindPanel::FindPanel(FindIndex index, QWidget* parent)
    : Popover{tr("Find"), parent},
      index_{std::move(index)},
      field_{new QLineEdit},
      list_{new FoundList},
      note_{new TextLabel{TextSize::Note, false, &Tokens::ink2}} {
    field_->setPlaceholderText(tr("Simplex, item, command or view"));
    field_->setAccessibleName(tr("Find a simplex, item, command or view"));
    field_->installEventFilter(this);
    list_->setColumnCount(3);
    list_->setHeaderHidden(true);
    list_->setRootIsDecorated(false);
    list_->setFocusPolicy(Qt::NoFocus);
    list_->setAccessibleName(tr("What was found"));
    setUpRows(*list_);
    setWidths(*list_, {90, 22});
    rows().addWidget(field_);
    rows().addWidget(list_);
    rows().addWidget(note_);
    connect(field_, &QLineEdit::textChanged, this, &FindPanel::search);
    connect(list_, &QTreeWidget::itemClicked, this, [this] { choose(false); });
    search();
    field_->setFocus();
}

void FindPanel::search() {
    found_ = index_.find(field_->text(), mostShown);
    list_->clear();
    for (const Found* each : found_) {
        auto* row = new QTreeWidgetItem{list_};
        setCell(*row, 0, QString::fromStdString(each->text()));
        setCell(*row, 1, kindText(each->kind));
        setCell(*row, 2, QString::fromStdString(each->type));
    }
    if (!found_.empty()) list_->setCurrentItem(list_->topLevelItem(0));
    if (field_->text().trimmed().isEmpty()) {
        note_->show(
            tr("%1 things can be found. Enter opens. Ctrl+Enter opens beside; it plots an item.")
                .arg(index_.size()));
    } else if (found_.empty()) {
        note_->show(tr("Nothing has all these words."));
    } else if (found_.size() == mostShown) {
        note_->show(tr("The best %1 are shown; more words narrow it.").arg(mostShown));
    } else {
        note_->show(tr("%1 found. Ctrl+Enter opens beside; it plots an item.").arg(found_.size()));
    }
}

// Up and down walk the list while one types.
bool FindPanel::eventFilter(QObject* object, QEvent* event) {
    if (event->type() != QEvent::KeyPress) return Popover::eventFilter(object, event);
    const auto* key = static_cast<QKeyEvent*>(event);
    const int row = list_->indexOfTopLevelItem(list_->currentItem());
    const int page = key->key() == Qt::Key_PageDown || key->key() == Qt::Key_PageUp ? 10 : 1;
    if (key->key() == Qt::Key_K && key->modifiers() == Qt::ControlModifier) {  // begins anew
        field_->selectAll();
        return true;
    }
    switch (key->key()) {
        case Qt::Key_Down:
        case Qt::Key_PageDown:
            list_->setCurrentItem(
                list_->topLevelItem(std::min(row + page, list_->topLevelItemCount() - 1)));
            return true;
        case Qt::Key_Up:
        case Qt::Key_PageUp:
            list_->setCurrentItem(list_->topLevelItem(std::max(row - page, 0)));
            return true;
        case Qt::Key_Return:
        case Qt::Key_Enter:
            choose(key->modifiers().testFlag(Qt::ControlModifier));
            return true;
        default:
            return Popover::eventFilter(object, event);
    }
}

FindPanel* openFindPanel(const Frame& frame, const std::vector<PageKind>& kinds,
                         const std::vector<FindAction>& actions, QWidget& button) {
    FindIndex index{frame};
    for (const PageKind& each : kinds) {
        index.add({FoundKind::View, each.kind.toStdString(), each.title.toStdString()});
    }
    for (std::size_t i = 0; i < actions.size(); ++i) {
        index.add({FoundKind::Action, std::to_string(i), actions[i].text.toStdString(),
                   actions[i].keys.toStdString(), actions[i].discards});
    }
    auto* panel = new FindPanel{std::move(index), button.window()};
    panel->openBelow(button.isVisible() ? button : *button.parentWidget());
    return panel;
}

void FindPanel::choose(bool beside) {
    const int row = list_->indexOfTopLevelItem(list_->currentItem());
    if (row < 0 || row >= static_cast<int>(found_.size())) return;
    const Found found = *found_[static_cast<std::size_t>(row)];
    close();
    Q_EMIT chosen(found, beside);
}

}  // namespace cortex::gui
