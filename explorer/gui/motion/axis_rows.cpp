// SPDX-License-Identifier: Apache-2.0
#include "motion/axis_rows.hpp"

#include <QKeyEvent>
#include <QPainter>
#include <QVBoxLayout>
#include <algorithm>

namespace cortex::explorer {

AxisRows::AxisRows(QWidget* parent) : QWidget{parent}, layout_{new QVBoxLayout{this}} {
    setFocusPolicy(Qt::StrongFocus);
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
    layout_->setSpacing(0);
    fit();
}

void AxisRows::fit() {
    layout_->setContentsMargins(0, units(7), 0, 0);  // the titles of the columns
    setMinimumWidth(units(leastRowUnits));
}

void AxisRows::make(const std::vector<MotionAxis>& axes, RowPart part, bool jogs) {
    for (AxisRow* each : rows_) delete each;
    rows_.clear();
    for (std::size_t i = 0; i < axes.size(); ++i) {
        const int axis = static_cast<int>(i);
        auto* row = new AxisRow{axes[i], part, jogs};
        connect(row, &AxisRow::chosen, this, [this, axis] {
            setFocus(Qt::MouseFocusReason);
            Q_EMIT chosen(axis);
        });
        connect(row, &AxisRow::pressed, this, [this, axis](int direction, QWidget* button) {
            Q_EMIT pressed(axis, direction, button);
        });
        connect(row, &AxisRow::edited, this, [this, axis] { Q_EMIT edited(axis); });
        layout_->addWidget(row);
        row->QWidget::show();
        rows_.push_back(row);
    }
    part_ = part;
    selected_ = std::clamp(selected_, 0, std::max(count() - 1, 0));
    describe();
}

void AxisRows::setPart(RowPart part) {
    if (part == part_) return;
    part_ = part;
    for (AxisRow* each : rows_) each->setPart(part);
}

void AxisRows::select(int axis) {
    if (axis < 0 || axis >= count()) return;
    selected_ = axis;
    describe();
}

int AxisRows::nameWidth() const {
    QFont strong = font();
    strong.setPointSizeF(strong.pointSizeF() * 1.2);
    strong.setWeight(QFont::DemiBold);
    const QFontMetrics metrics{strong};
    int longest = units(leastName);
    for (const AxisRow* each : rows_)
        longest = std::max(longest, metrics.horizontalAdvance(each->accessibleName()) + 1);
    return std::min(longest, units(mostName));
}

void AxisRows::describe() {
    setAccessibleName(tr("Axes"));
    setAccessibleDescription(count() > 0 ? row(selected_).accessibleName() : QString{});
}

void AxisRows::setTitles(const QString& value, const QString& target, const QString& act) {
    if (value == value_ && target == target_ && act == act_) return;
    value_ = value;
    target_ = target;
    act_ = act;
    update();
}

void AxisRows::paintEvent(QPaintEvent* /*event*/) {
    if (rows_.empty()) return;
    QPainter painter{this};
    const int high = units(7);
    const RowColumns columns = columnsOf(width(), high, nameWidth());
    QFont small = font();
    small.setPointSizeF(small.pointSizeF() * 0.9);
    painter.setFont(small);
    painter.setPen(textColour(Tone::Quiet));
    const auto title = [&](const QRect& box, int align, const QString& text) {
        painter.drawText(box, align | Qt::AlignVCenter | Qt::TextSingleLine,
                         painter.fontMetrics().elidedText(text, Qt::ElideRight, box.width()));
    };
    title(columns.name, Qt::AlignLeft, tr("Axis"));
    title(columns.bar, Qt::AlignLeft, tr("Position, target"));
    title(columns.value.adjusted(-units(2), 0, 0, 0), Qt::AlignRight, value_);
    title(columns.target.adjusted(-units(2), 0, 0, 0), Qt::AlignRight, target_);
    title(columns.act, Qt::AlignLeft, act_);
    if (columns.drive.width() >= units(10)) title(columns.drive, Qt::AlignLeft, tr("Drive"));
    painter.fillRect(QRect{units(4), high - 1, width() - units(6), 1},
                     palette().color(QPalette::Mid));
}

// A key that repeats itself is held, and begins nothing.
void AxisRows::keyPressEvent(QKeyEvent* event) {
    const int key = event->key();
    const bool jogs = part_ == RowPart::Jog && (key == Qt::Key_Left || key == Qt::Key_Right);
    const bool chooses = key == Qt::Key_Up || key == Qt::Key_Down;
    if (rows_.empty() || (!jogs && !chooses) || (event->modifiers() & ~Qt::KeypadModifier) != 0) {
        QWidget::keyPressEvent(event);
        return;
    }
    if (chooses) {
        const int next = selected_ + (key == Qt::Key_Down ? 1 : -1);
        if (next >= 0 && next < count()) Q_EMIT chosen(next);
    } else if (!event->isAutoRepeat()) {
        setFocus(Qt::OtherFocusReason);  // it may have come from a button
        Q_EMIT pressed(selected_, key == Qt::Key_Right ? 1 : -1, this);
    }
}

void AxisRows::focusInEvent(QFocusEvent* event) {
    QWidget::focusInEvent(event);
    update();
}

void AxisRows::focusOutEvent(QFocusEvent* event) {
    QWidget::focusOutEvent(event);
    update();
}

void AxisRows::changeEvent(QEvent* event) {
    QWidget::changeEvent(event);
    if (event->type() == QEvent::StyleChange || event->type() == QEvent::FontChange) fit();
}

}  // namespace cortex::explorer
