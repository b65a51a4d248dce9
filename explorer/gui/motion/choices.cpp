// SPDX-License-Identifier: Apache-2.0
#include "motion/choices.hpp"

#include "cortex/explorer/theme.hpp"

#include <QEvent>
#include <QHBoxLayout>
#include <QPushButton>
#include <algorithm>

namespace cortex::explorer {

Choices::Choices(const std::vector<std::pair<QString, QString>>& choices, QWidget* parent)
    : QWidget{parent} {
    auto* row = new QHBoxLayout{this};
    row->setContentsMargins(0, 0, 0, 0);
    row->setSpacing(units(0.5));
    for (const auto& choice : choices) {
        auto* button = new QPushButton{choice.second};
        button->setCheckable(true);
        button->setFocusPolicy(Qt::TabFocus);  // a click leaves the keys where they were
        connect(button, &QPushButton::clicked, this, [this, button, name = choice.first] {
            button->setChecked(!button->isChecked());  // until it is so
            Q_EMIT wanted(name);
        });
        row->addWidget(button);
        buttons_.emplace_back(choice.first, button);
    }
    setSizePolicy(QSizePolicy::Fixed, QSizePolicy::Fixed);
    fit();
}

// As wide as their texts: several stand in a row that may be narrow.
void Choices::fit() {
    for (const auto& [name, button] : buttons_) {
        const int text = button->fontMetrics().horizontalAdvance(button->text());
        button->setFixedWidth(std::max({text + units(5), units(10), leastWidth_}));
    }
}

void Choices::changeEvent(QEvent* event) {
    QWidget::changeEvent(event);
    if (event->type() == QEvent::StyleChange || event->type() == QEvent::FontChange) fit();
}

void Choices::show(const QString& chosen) {
    for (const auto& [name, button] : buttons_) button->setChecked(name == chosen);
}

void Choices::setWhyNot(const QString& why) {
    for (const auto& [name, button] : buttons_) {
        button->setEnabled(why.isEmpty());
        button->setToolTip(why);
    }
}

void Choices::rename(const QString& name, const QString& text) {
    QPushButton* each = button(name);
    if (each == nullptr || each->text() == text) return;
    each->setText(text);
    fit();
}

void Choices::keepWidth(int pixels) {
    if (pixels == leastWidth_) return;
    leastWidth_ = pixels;
    fit();
}

QPushButton* Choices::button(const QString& name) const {
    for (const auto& [each, button] : buttons_) {
        if (each == name) return button;
    }
    return nullptr;
}

}  // namespace cortex::explorer
