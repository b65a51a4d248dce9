// SPDX-License-Identifier: Apache-2.0
#include "views/life_cycle_bar.hpp"

#include "model/outcome_text.hpp"
#include "model/permission.hpp"
#include "model/plain_text.hpp"
#include "widgets/text_label.hpp"

#include <QGridLayout>
#include <QPushButton>
#include <algorithm>

namespace cortex::gui {

namespace {

constexpr std::chrono::milliseconds transitionLimit = std::chrono::seconds{30};

}  // namespace

LifeCycleBar::LifeCycleBar(Commands& commands, QWidget* parent)
    : QWidget{parent}, commands_{commands} {
    auto* grid = new QGridLayout{this};
    grid->setContentsMargins(0, 0, 0, 0);
    grid->setHorizontalSpacing(Look::units(2));
    grid->setVerticalSpacing(0);
    const std::array<std::pair<const char*, QString>, 3> all{{{"startup", tr("Startup")},
                                                              {"shutdown", tr("Shutdown")},
                                                              {"clearFaults", tr("Clear faults")}}};
    for (int i = 0; i < 3; ++i) {
        const auto& [command, title] = all[static_cast<std::size_t>(i)];
        Button& each = buttons_[static_cast<std::size_t>(i)];
        each = {command, new QPushButton{title},
                new TextLabel{TextSize::Note, false, &Tokens::ink2}};
        each.button->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
        each.reason->setWordWrap(true);
        each.reason->setAlignment(Qt::AlignLeft | Qt::AlignTop);
        each.reason->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
        grid->addWidget(each.button, 0, i);
        grid->addWidget(each.reason, 1, i);
        grid->setColumnStretch(i, 1);
        connect(each.button, &QPushButton::clicked, this, [this, &each] {
            commands_.send(path_, each.command, {}, transitionLimit, this,
                           [this](const CommandOutcome&) { tell(); });
            tell();
        });
    }
}

void LifeCycleBar::show(const std::string& path) {
    path_ = path;
    tell();
}

int LifeCycleBar::leastWidth() const {
    int width = Look::units(32);
    for (const Button& each : buttons_) width = std::max(width, each.button->sizeHint().width());
    return width;
}

QSize LifeCycleBar::sizeWith(int width) const {
    const auto* grid = static_cast<const QGridLayout*>(layout());
    return {3 * width + 2 * grid->horizontalSpacing(), grid->sizeHint().height()};
}

QSize LifeCycleBar::sizeHint() const {
    const QString usual = tr("read-only: take control of /");
    const QFontMetrics metrics{buttons_.front().reason->font()};
    return sizeWith(std::max(leastWidth(), metrics.horizontalAdvance(usual) + 2));
}

QSize LifeCycleBar::minimumSizeHint() const { return sizeWith(leastWidth()); }

// Room for the reasons, whether it is needed or not, and more where one is longer.
void LifeCycleBar::fit() {
    const auto* grid = static_cast<const QGridLayout*>(layout());
    const int width = std::max((this->width() - 2 * grid->horizontalSpacing()) / 3, leastWidth());
    int height = buttons_.front().reason->heightOfLines(lines_);
    for (const Button& each : buttons_)
        height = std::max(height, each.reason->heightForWidth(width));
    for (Button& each : buttons_) {
        each.button->setMinimumWidth(each.button->sizeHint().width());
        if (height != each.reason->minimumHeight()) each.reason->setFixedHeight(height);
    }
}

void LifeCycleBar::resizeEvent(QResizeEvent* event) {
    QWidget::resizeEvent(event);
    fit();
}

void LifeCycleBar::refresh(const Frame& frame, Place place) {
    const Type& type = frame.type(place);
    const bool shown = type.active() && !type.isA("Agent");  // an agent's own have a prefix: forms
    setVisible(shown);
    if (!shown) return;
    tell();
    for (Button& each : buttons_) {
        const auto command = std::ranges::find(type.commands, each.command, &Command::name);
        const QString why = command == type.commands.end()
                                ? tr("its type has no %1").arg(each.button->text())
                                : whyNotNow(frame, place, command->available, each.command);
        each.button->setEnabled(why.isEmpty());
        each.reason->show(why);
        each.reason->setToolTip(tipText(why));
    }
    fit();
}

// What became of the last one stays with its simplex, whoever sent it from this window.
void LifeCycleBar::tell() {
    const Commands::Last* newest = nullptr;
    QString title;
    for (const Button& each : buttons_) {
        const Commands::Last* last = commands_.last(path_, each.command);
        if (last == nullptr || (newest != nullptr && newest->number > last->number)) continue;
        newest = last;
        title = each.button->text();
    }
    QString text;
    if (newest != nullptr) {
        text = newest->outcome ? tr("%1: %2").arg(title, outcomeText(*newest->outcome))
                               : tr("%1: sending").arg(title);
    }
    if (text == told_) return;
    told_ = text;
    Q_EMIT told(text);
}

}  // namespace cortex::gui
