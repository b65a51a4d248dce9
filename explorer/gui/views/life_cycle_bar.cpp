// SPDX-License-Identifier: Apache-2.0
#include "views/life_cycle_bar.hpp"

#include "model/outcome_text.hpp"
#include "model/permission.hpp"
#include "model/plain_text.hpp"
#include "widgets/low_buttons.hpp"
#include "widgets/text_label.hpp"

#include <QGridLayout>
#include <QPushButton>
#include <algorithm>
#include <utility>
#include <vector>

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
    kept_ = 0;
    tell();
}

void LifeCycleBar::setLines(int lines) {
    if (lines == lines_) return;
    lines_ = lines;
    kept_ = 0;
    for (Button& each : buttons_) {
        each.reason->setVisible(lines_ > 0);
        lowerWhereLow({each.button});
    }
    updateGeometry();
}

int LifeCycleBar::leastWidth() const {
    int width = lines_ > 0 ? Look::units(32) : 0;
    for (const Button& each : buttons_) width = std::max(width, each.button->sizeHint().width());
    return width;
}

QSize LifeCycleBar::sizeWith(int width) const {
    const auto* grid = static_cast<const QGridLayout*>(layout());
    const QPushButton& any = *buttons_.front().button;
    const int low = std::min(any.sizeHint().height(), any.maximumHeight());
    const int height = lines_ > 0 ? grid->sizeHint().height() : low;
    return {3 * width + 2 * grid->horizontalSpacing(), height};
}

QSize LifeCycleBar::sizeHint() const {
    if (lines_ == 0) return minimumSizeHint();
    const QString usual = tr("read-only: take control of /");
    const QFontMetrics metrics{buttons_.front().reason->font()};
    return sizeWith(std::max(leastWidth(), metrics.horizontalAdvance(usual) + 2));
}

QSize LifeCycleBar::minimumSizeHint() const { return sizeWith(leastWidth()); }

// Room for the reasons, whether it is needed or not, also for that of a window without control.
// What was longer once keeps its room: nothing moves when it goes.
void LifeCycleBar::fit() {
    const auto* grid = static_cast<const QGridLayout*>(layout());
    const int width = std::max((this->width() - 2 * grid->horizontalSpacing()) / 3, leastWidth());
    if (std::exchange(wide_, width) != width) kept_ = 0;
    TextLabel readOnly{TextSize::Note};
    readOnly.setWordWrap(true);
    readOnly.show(readOnly_);
    kept_ = std::max({kept_, readOnly.heightOfLines(lines_), readOnly.heightForWidth(width)});
    for (const Button& each : buttons_) kept_ = std::max(kept_, each.reason->heightForWidth(width));
    for (Button& each : buttons_) {
        each.button->setMinimumWidth(each.button->sizeHint().width());
        if (kept_ != each.reason->minimumHeight()) each.reason->setFixedHeight(kept_);
    }
}

void LifeCycleBar::resizeEvent(QResizeEvent* event) {
    QWidget::resizeEvent(event);
    if (lines_ > 0) fit();
}

void LifeCycleBar::refresh(const Frame& frame, Place place) {
    const Type& type = frame.type(place);
    const bool shown = type.active() && !type.isA("Agent");  // an agent's own have a prefix: forms
    setVisible(shown);
    if (!shown) {
        for (Button& each : buttons_) each.reason->show({});
        return;
    }
    tell();
    readOnly_ = whyWithoutControl(frame, place);
    for (Button& each : buttons_) {
        const auto command = std::ranges::find(type.commands, each.command, &Command::name);
        const QString why = command == type.commands.end()
                                ? tr("its type has no %1").arg(each.button->text())
                                : whyNotNow(frame, place, command->available, each.command);
        each.button->setEnabled(why.isEmpty());
        each.reason->show(why);
        each.reason->setToolTip(tipText(why));
        each.button->setToolTip(lines_ == 0 ? tipText(why) : QString{});
    }
    if (lines_ > 0) fit();
}

QString LifeCycleBar::reasons() const {
    std::vector<std::pair<QString, QStringList>> all;  // each with its buttons
    for (const Button& each : buttons_) {
        const QString& why = each.reason->text();
        const auto found = std::ranges::find(all, why, &std::pair<QString, QStringList>::first);
        if (why.isEmpty()) continue;
        if (found == all.end())
            all.emplace_back(why, QStringList{each.button->text()});
        else
            found->second << each.button->text();
    }
    QStringList texts;
    for (const auto& [why, buttons] : all)
        texts << tr("%1: %2").arg(buttons.join(QStringLiteral(", ")), why);
    return texts.join(QStringLiteral("; "));
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
