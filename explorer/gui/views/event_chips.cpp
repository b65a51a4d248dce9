// SPDX-License-Identifier: Apache-2.0
#include "views/event_chips.hpp"

#include "model/plain_text.hpp"
#include "widgets/chip.hpp"
#include "widgets/flow_layout.hpp"

#include <array>

namespace cortex::gui {

namespace {

constexpr std::array bySeverity{Severity::Error, Severity::Warning, Severity::Info};

}  // namespace

EventChips::EventChips(EventFilter& events, QWidget* parent) : QWidget{parent}, events_{events} {
    setLayout(new FlowLayout{1.5});
    QSizePolicy policy{QSizePolicy::Preferred, QSizePolicy::Fixed};
    policy.setHeightForWidth(true);
    setSizePolicy(policy);
    for (const Severity each : bySeverity) {
        severities_[each] =
            add(new Chip{QString::fromLatin1(name(each)), shapeOf(each)}, events.shows(each),
                [this, each](bool shown) { events_.showSeverity(each, shown); });
    }
    routine_ = add(new Chip{tr("jog")}, events.showsRoutine(),
                   [this](bool shown) { events_.showRoutine(shown); });
    refresh();
}

Chip* EventChips::add(Chip* chip, bool shown, const std::function<void(bool)>& show) {
    chip->setChecked(shown);
    layout()->addWidget(chip);
    connect(chip, &QAbstractButton::toggled, this, show);
    return chip;
}

// What is shown may have been changed elsewhere, too.
void EventChips::refresh() {
    const EventFilter::Counts& counts = events_.counts();
    for (const auto& [severity, chip] : severities_) {
        chip->setChecked(events_.shows(severity));
        chip->show(counts.severities[static_cast<std::size_t>(severity)]);
    }
    const auto& kinds = events_.events().kinds();
    for (std::size_t i = 0; i < kinds.size() && i < counts.kinds.size(); ++i) {
        const std::string& kind = kinds[i];
        if (kind == EventRow::missingKind) continue;
        Chip*& chip = kinds_[kind];
        if (chip == nullptr) {
            chip = add(new Chip{plainText(kind)}, events_.shows(kind),
                       [this, kind](bool shown) { events_.showKind(kind, shown); });
        }
        chip->setChecked(events_.shows(kind));
        chip->show(counts.kinds[i]);
        chip->setVisible(counts.kinds[i] > 0 || !events_.shows(kind));
    }
    routine_->setChecked(events_.showsRoutine());
    routine_->show(counts.routine);
    routine_->setVisible(counts.routine > 0 || events_.showsRoutine());
}

}  // namespace cortex::gui
