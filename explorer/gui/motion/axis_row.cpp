// SPDX-License-Identifier: Apache-2.0
#include "motion/axis_row.hpp"

#include "motion/jog_button.hpp"

#include <QLabel>
#include <QLineEdit>
#include <QMouseEvent>
#include <QPushButton>
#include <algorithm>

namespace cortex::explorer {

namespace {

constexpr const char* wrongInput = "wrongInput";  // makes the edge of a field amber

}  // namespace

AxisRow::AxisRow(const MotionAxis& axis, RowPart part, bool jogs, QWidget* parent)
    : QWidget{parent}, axis_{axis}, part_{part}, field_{new QLineEdit{this}} {
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
    setAccessibleName(axis.name);
    setToolTip(QString::fromStdString(axis.axis));
    addButtons();
    field_->setAlignment(Qt::AlignRight);
    field_->setAccessibleName(tr("Demand of %1").arg(axis.name));
    connect(field_, &QLineEdit::textEdited, this, &AxisRow::edited);
    if (jogs && !axis.most) addSpeedField();
    setPart(part);
}

void AxisRow::addButtons() {
    for (const int direction : {-1, 1}) {
        auto* button =
            new JogButton{direction > 0 ? QStringLiteral("+") : QString{QChar{0x2212}}, this};
        button->setAccessibleName(direction > 0 ? tr("Jog %1 forwards").arg(axis_.name)
                                                : tr("Jog %1 backwards").arg(axis_.name));
        connect(button, &QPushButton::pressed, this,
                [this, direction, button] { Q_EMIT pressed(direction, button); });
        buttons_[direction > 0 ? 1 : 0] = button;
    }
}

// Without a greatest speed there is nothing that a share could be of.
void AxisRow::addSpeedField() {
    noSpeed_ = new QLabel{this};
    noSpeed_->setTextFormat(Qt::PlainText);
    noSpeed_->setWordWrap(true);
    speedField_ = new QLineEdit{this};
    speedField_->setAlignment(Qt::AlignRight);
    speedField_->setAccessibleName(tr("Greatest speed of %1").arg(axis_.name));
    connect(speedField_, &QLineEdit::textEdited, this, [this](const QString& text) {
        speed_ = look_.velocity.entered(text);
        if (speed_ && *speed_ <= 0) speed_.reset();
        speedField_->setProperty(wrongInput, !speed_ && !text.isEmpty());
        speedField_->update();
    });
}

void AxisRow::setPart(RowPart part) {
    part_ = part;
    const bool jogs = part == RowPart::Jog;
    for (QPushButton* each : buttons_) each->setVisible(jogs);
    field_->setVisible(part == RowPart::Demand);
    if (noSpeed_ != nullptr) {
        noSpeed_->setVisible(jogs);
        speedField_->setVisible(jogs);
    }
    fit();
}

std::optional<double> AxisRow::most() const { return axis_.most ? axis_.most : speed_; }

void AxisRow::show(const MotionAxis& axis, const RowLook& look) {
    const bool moved = look.nameWidth != look_.nameWidth;
    const bool otherUnit = look.position.unit.text != look_.position.unit.text;
    axis_ = axis;
    look_ = look;
    if (moved) place();
    for (const int direction : {-1, 1}) {
        QPushButton& button = this->button(direction);
        button.setDown(look.held == direction);
        if (look.held != 0) continue;  // what is held ends with its own reason
        const bool atLimit = axis.isAtLimit(direction);
        button.setEnabled(look.whyNot.isEmpty() && !atLimit);
        QStringList reasons{look.whyNot, atLimit ? axis.limitText() : QString{}};
        reasons.removeAll({});
        button.setToolTip(reasons.join(QStringLiteral("; ")));
    }
    showField(otherUnit);
    if (noSpeed_ != nullptr) {
        const QString text = tr("%1 states no greatest speed. Speed (%2) at 100 %:")
                                 .arg(axis.demandType, look.velocity.unit.text);
        if (noSpeed_->text() != text) {
            noSpeed_->setText(text);
            fit();
        }
    }
    describe();
    update();
}

// What is being typed stays as it is, but never as a number of another unit.
void AxisRow::showField(bool otherUnit) {
    field_->setEnabled(true);
    const bool typed = look_.edited || field_->hasFocus();
    if (!typed || (otherUnit && look_.entered)) {
        const QString text = look_.entered ? look_.position.text(*look_.entered) : QString{};
        if (field_->text() != text) field_->setText(text);
    }
    if (field_->toolTip() == look_.wrong) return;
    field_->setToolTip(look_.wrong);
    field_->setAccessibleDescription(look_.wrong);
    field_->setProperty(wrongInput, !look_.wrong.isEmpty());
    field_->update();
}

// What is painted, in words: for those who do not see it, and for tests.
void AxisRow::describe() {
    QStringList parts{
        tr("value %1")
            .arg(axis_.position ? look_.position.withUnit(*axis_.position) : QStringLiteral("—")),
        tr("target %1")
            .arg(axis_.wished ? look_.position.withUnit(*axis_.wished) : QStringLiteral("—"))};
    if (!axis_.live) parts << tr("not live");
    if (const QString limit = axis_.limitText(); !limit.isEmpty()) parts << limit;
    if (axis_.drive) parts << tr("drive %1").arg(QLatin1String{name(*axis_.drive)});
    const QString text = parts.join(QStringLiteral(", "));
    if (accessibleDescription() != text) setAccessibleDescription(text);
}

void AxisRow::place() {
    const RowColumns columns = columnsOf(width(), mainHeight(), look_.nameWidth);
    const QSize size{units(buttonWide), units(buttonHigh)};
    const int top = (mainHeight() - size.height()) / 2;
    buttons_[0]->setGeometry({{columns.act.left(), top}, size});
    buttons_[1]->setGeometry({{columns.act.right() + 1 - size.width(), top}, size});
    const int high = units(7);
    field_->setGeometry(columns.act.left() + units(3), (mainHeight() - high) / 2,
                        columns.act.width() - units(3), high);
    if (noSpeed_ == nullptr) return;
    const int wide = columns.act.left() - columns.name.left() - units(2);
    noSpeed_->setGeometry(columns.name.left(), mainHeight(), wide, secondHeight());
    speedField_->setGeometry(columns.act.left(), mainHeight(), units(18), high);
}

// As for the narrowest row, whatever the width: a height that followed it would move scroll bars.
int AxisRow::secondHeight() const {
    const RowColumns columns = columnsOf(units(leastRowUnits), mainHeight(), units(leastName));
    const int wide = columns.act.left() - columns.name.left() - units(2);
    return std::max(noSpeed_->heightForWidth(wide), units(7));
}

void AxisRow::fit() {
    const bool second = noSpeed_ != nullptr && part_ == RowPart::Jog;
    setFixedHeight(mainHeight() + (second ? secondHeight() + units(2) : 0));
    place();
}

void AxisRow::resizeEvent(QResizeEvent* /*event*/) { place(); }

void AxisRow::changeEvent(QEvent* event) {
    QWidget::changeEvent(event);
    if (event->type() != QEvent::StyleChange && event->type() != QEvent::FontChange) return;
    fit();
}

void AxisRow::mousePressEvent(QMouseEvent* event) {
    Q_EMIT chosen();
    event->accept();
}

}  // namespace cortex::explorer
