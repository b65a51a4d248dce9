// SPDX-License-Identifier: Apache-2.0
#include "window/control_notice.hpp"

#include "style/look.hpp"
#include "widgets/text_label.hpp"

#include <QHBoxLayout>
#include <QPainter>
#include <QPushButton>
#include <initializer_list>

namespace cortex::gui {

ControlNotice::ControlNotice(QWidget* parent)
    : QWidget{parent},
      text_{new TextLabel{TextSize::Text, true, &Tokens::warnText}},
      remedy_{new QPushButton},
      close_{new QPushButton{tr("Close")}} {
    auto* row = new QHBoxLayout{this};
    row->setContentsMargins(Look::units(4), 0, Look::units(2), 0);
    text_->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
    for (QWidget* each : std::initializer_list<QWidget*>{text_, remedy_, close_}) {
        row->addWidget(each);
        each->hide();
    }
    for (QPushButton* each : {remedy_, close_}) each->setFocusPolicy(Qt::TabFocus);
    connect(close_, &QPushButton::clicked, this, &ControlNotice::closed);
    fit();
}

void ControlNotice::show(const QString& text, const QString& remedy) {
    fit();
    if (text != text_->text()) update();
    text_->show(text);
    remedy_->setText(remedy);
    text_->setVisible(!text.isEmpty());
    close_->setVisible(!text.isEmpty());
    remedy_->setVisible(!text.isEmpty() && !remedy.isEmpty());
}

QString ControlNotice::text() const { return text_->text(); }

// The buttons are low, so that the room that is kept is small.
void ControlNotice::fit() {
    const int height = Look::units(7);
    if (maximumHeight() == height) return;
    setFixedHeight(height);
    for (QPushButton* each : {remedy_, close_}) each->setFixedHeight(height - Look::units(1));
}

void ControlNotice::paintEvent(QPaintEvent* /*event*/) {
    if (!text_->text().isEmpty()) QPainter{this}.fillRect(rect(), Look::colours().warnBg);
}

}  // namespace cortex::gui
