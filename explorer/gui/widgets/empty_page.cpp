// SPDX-License-Identifier: Apache-2.0
#include "widgets/empty_page.hpp"

#include "widgets/text_label.hpp"

#include <QVBoxLayout>

namespace cortex::gui {

EmptyPage::EmptyPage(QWidget* parent)
    : QWidget{parent},
      title_{new TextLabel{TextSize::Empty}},
      text_{new TextLabel{TextSize::Text, false, &Tokens::ink2}} {
    auto* lines = new QVBoxLayout{this};
    lines->addStretch(1);
    for (TextLabel* each : {title_, text_}) {
        each->setAlignment(Qt::AlignCenter);
        each->setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Fixed);
        lines->addWidget(each);
    }
    lines->addStretch(2);
}

void EmptyPage::show(const QString& title, const QString& text) {
    title_->show(title);
    text_->show(text);
}

}  // namespace cortex::gui
