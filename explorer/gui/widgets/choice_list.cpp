// SPDX-License-Identifier: Apache-2.0
#include "widgets/choice_list.hpp"

#include "model/plain_text.hpp"
#include "style/look.hpp"

#include <QKeyEvent>
#include <QScrollBar>
#include <QWheelEvent>
#include <algorithm>

namespace cortex::gui {

namespace {

constexpr int mostChoicesSeen = 10, choicePage = 5;
constexpr double widestChoice = 90;  // units

}  // namespace

ChoiceList::ChoiceList(const Choices& choices, bool numbered, QLineEdit& field)
    : QListWidget{field.window()}, choices_{choices}, field_{&field} {
    setFocusPolicy(Qt::NoFocus);
    setFocusProxy(&field);  // a click leaves the keyboard where it is
    setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    setFrameShape(QFrame::Box);
    setFrameShadow(QFrame::Plain);
    setLineWidth(Look::lineWidth());
    setTextElideMode(Qt::ElideRight);
    setUniformItemSizes(true);
    setAccessibleName(tr("What can be entered"));
    for (const auto& [number, label] : choices_) {
        const QString digits = QString::number(number);
        // Two may have the same.
        texts_ << (texts_.contains(label) || !isPlain(label) ? digits : label);
        QString shown = isolatedText(label.left(200).toStdString());
        if (numbered) shown += QStringLiteral(" (%1)").arg(digits);
        addItem(shown);
    }
    connect(this, &QAbstractItemView::clicked, this, [this](const QModelIndex& row) {
        enter(row.row());
        Q_EMIT taken();
    });
    for (QWidget* each = &field; each != nullptr; each = each->parentWidget()) {
        each->installEventFilter(this);
        if (each->isWindow()) break;
    }
    hide();
}

int ChoiceList::rowOf(const QString& text, bool isValue) const {
    const QString typed = text.trimmed();
    if (typed.isEmpty()) return -1;
    if (const int whole = texts_.indexOf(typed); whole >= 0) return whole;
    const auto found =
        isValue ? std::ranges::find(choices_, typed.toLongLong(), &Choices::value_type::first)
                : std::ranges::find_if(choices_, [&](const auto& each) {
                      return each.second.startsWith(typed, Qt::CaseInsensitive);
                  });
    return found == choices_.end() ? -1 : static_cast<int>(found - choices_.begin());
}

bool ChoiceList::follow(const QString& text, bool isValue) {
    const int row = rowOf(text, isValue);
    setCurrentRow(row);
    if (row < 0) clearSelection();
    return row >= 0;
}

QString ChoiceList::chosen() const { return texts_.value(currentRow()); }

void ChoiceList::setUseful(bool isUseful) {
    isUseful_ = isUseful;
    fit();
}

void ChoiceList::enter(int row) {
    if (!field_ || row < 0) return;
    field_->setText(texts_[row]);
    field_->setModified(true);  // also where it is as before: a person chose it
    field_->selectAll();
}

bool ChoiceList::walk(int key) {
    const int last = count() - 1;
    switch (key) {
        case Qt::Key_Down:
            enter(std::min(currentRow() + 1, last));
            return true;
        case Qt::Key_Up:
            enter(currentRow() < 0 ? last : std::max(currentRow() - 1, 0));
            return true;
        case Qt::Key_PageDown:
            enter(std::min(currentRow() + choicePage, last));
            return true;
        case Qt::Key_PageUp:
            enter(std::max(currentRow() - choicePage, 0));
            return true;
        default:
            return false;
    }
}

bool ChoiceList::eventFilter(QObject* watched, QEvent* event) {
    const QEvent::Type type = event->type();
    const bool changes = type == QEvent::Resize || type == QEvent::Move || type == QEvent::Hide ||
                         type == QEvent::Show;
    const bool turns = type == QEvent::FocusIn || type == QEvent::FocusOut;
    if (changes || (turns && watched == field_)) fit();
    if (watched == field_ && type == QEvent::KeyPress) {
        const auto* key = static_cast<QKeyEvent*>(event);
        if ((key->modifiers() & ~Qt::KeypadModifier) == 0 && walk(key->key())) return true;
    }
    return QListWidget::eventFilter(watched, event);
}

// It scrolls the list, and neither chooses nor reaches what is below it.
void ChoiceList::wheelEvent(QWheelEvent* event) {
    QListWidget::wheelEvent(event);
    event->accept();
}

// Below the field, or above it where there is more room.
void ChoiceList::fit() {
    const bool seen = field_ && isUseful_ && field_->isVisible() &&
                      field_->window()->focusWidget() == field_ &&
                      !field_->visibleRegion().isEmpty();
    if (!seen) return hide();
    const QWidget& around = *parentWidget();
    const QRect field{field_->mapTo(&around, QPoint{}), field_->size()};
    const int frame = 2 * frameWidth(), row = std::max(sizeHintForRow(0), 1);
    const int below = around.height() - field.bottom() - 1, above = field.top();
    const int wanted = std::min(count(), mostChoicesSeen) * row + frame;
    const bool isBelow = below >= wanted || below >= above;
    const int height = std::min(wanted, isBelow ? below : above);
    const int widest = sizeHintForColumn(0) + frame + verticalScrollBar()->sizeHint().width();
    const int width = std::min(
        std::clamp(widest, field.width(), std::max(field.width(), Look::units(widestChoice))),
        around.width());
    setGeometry(std::clamp(field.left(), 0, around.width() - width),
                isBelow ? field.bottom() + 1 : field.top() - height, width, height);
    raise();
    show();
    if (currentRow() >= 0) scrollToItem(currentItem());
}

}  // namespace cortex::gui
