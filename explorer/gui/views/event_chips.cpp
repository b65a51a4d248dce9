// SPDX-License-Identifier: Apache-2.0
#include "views/event_chips.hpp"

#include "common/kind_meaning.hpp"
#include "model/plain_text.hpp"
#include "style/look.hpp"
#include "widgets/chip.hpp"

#include <QMenu>
#include <QToolButton>
#include <array>

namespace cortex::gui {

namespace {

constexpr std::array bySeverity{Severity::Error, Severity::Warning, Severity::Info};
constexpr double chipHeight = 7, chipGap = 1.5;  // units

}  // namespace

EventChips::EventChips(EventFilter& events, QWidget* parent)
    : QWidget{parent}, events_{events}, more_{new QToolButton{this}} {
    setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Fixed);
    more_->setAutoRaise(true);
    more_->setToolTip(tr("The kinds that have no room here"));
    more_->hide();
    connect(more_, &QToolButton::clicked, this, &EventChips::openMenu);
    for (const Severity each : bySeverity) {
        severities_[each] =
            add(new Chip{QString::fromLatin1(name(each)), shapeOf(each)}, events.shows(each),
                [this, each](bool shown) { events_.showSeverity(each, shown); });
    }
    refresh();
}

Chip* EventChips::add(Chip* chip, bool shown, const std::function<void(bool)>& show) {
    chip->setParent(this);
    chip->setChecked(shown);
    connect(chip, &QAbstractButton::toggled, this, show);
    chips_.push_back(chip);
    return chip;
}

// No chip becomes wider while the pointer is among them.
void EventChips::show(Chip& chip, bool shown, std::uint64_t count) {
    chip.setChecked(shown);
    chip.show(count, !underMouse() || chip.isHidden());
}

// What is shown may have been changed elsewhere, too.
void EventChips::refresh() {
    const EventFilter::Counts& counts = events_.counts();
    for (const auto& [severity, chip] : severities_)
        show(*chip, events_.shows(severity), counts.severities[static_cast<std::size_t>(severity)]);
    const auto& kinds = events_.events().kinds();
    for (std::size_t i = 0; i < kinds.size() && i < counts.kinds.size(); ++i) {
        const std::string& kind = kinds[i];
        if (kind == EventRow::missingKind) continue;
        Chip*& chip = kinds_[kind];
        if (chip == nullptr) {
            chip = add(new Chip{plainText(kind)}, events_.shows(kind),
                       [this, kind](bool shown) { events_.showKind(kind, shown); });
            const std::string_view meaning = common::kindMeaning(kind);
            chip->explain(tr(std::string{meaning}.c_str()));
        }
        show(*chip, events_.shows(kind), counts.kinds[i]);
    }
    if (routine_ == nullptr && (counts.routine > 0 || events_.showsRoutine())) {
        routine_ = add(new Chip{tr("jog")}, events_.showsRoutine(),
                       [this](bool shown) { events_.showRoutine(shown); });
        routine_->explain(tr("Commands that repeat while somebody jogs an axis."));
    }
    if (routine_ != nullptr) show(*routine_, events_.showsRoutine(), counts.routine);
    place();
}

void EventChips::setRows(int rows) {
    if (rows == rows_) return;
    rows_ = rows;
    updateGeometry();
    place();
}

int EventChips::moreWidth() const {
    return more_->fontMetrics().horizontalAdvance(tr("%1 more ▾").arg(99)) + Look::units(4);
}

// As many rows as there are, whatever is in them.
QSize EventChips::sizeHint() const {
    return {Look::units(100), rows_ * Look::units(chipHeight) + (rows_ - 1) * Look::units(chipGap)};
}

QSize EventChips::minimumSizeHint() const { return {moreWidth(), sizeHint().height()}; }

// Row by row. The end of the last row is the button's, so that no chip goes when another comes.
void EventChips::place() {
    const int gap = Look::units(chipGap), step = Look::units(chipHeight) + gap;
    int x = 0, row = 0, hidden = 0;
    for (Chip* each : chips_) {
        const QSize size = each->sizeHint();
        if (x > 0 && x + size.width() > width() && row + 1 < rows_) {
            x = 0;
            ++row;
        }
        const int room = row + 1 < rows_ ? width() : width() - moreWidth() - gap;
        const bool fits = hidden == 0 && x + size.width() <= room;
        each->setVisible(fits);
        if (fits) each->setGeometry(QRect{QPoint{x, row * step}, size});
        if (!fits) ++hidden;
        x += size.width() + gap;
    }
    more_->setText(tr("%1 more ▾").arg(hidden));
    more_->setVisible(hidden > 0);
    more_->setGeometry(width() - moreWidth(), (rows_ - 1) * step, moreWidth(),
                       Look::units(chipHeight));
}

void EventChips::openMenu() {
    auto* menu = new QMenu{this};
    menu->setAttribute(Qt::WA_DeleteOnClose);
    for (Chip* each : chips_) {
        if (!each->isHidden()) continue;
        QAction* shows = menu->addAction(each->accessibleName(), each, &Chip::toggle);
        shows->setCheckable(true);
        shows->setChecked(each->isChecked());
    }
    menu->popup(more_->mapToGlobal({0, more_->height()}));
}

void EventChips::resizeEvent(QResizeEvent* event) {
    QWidget::resizeEvent(event);
    place();
}

}  // namespace cortex::gui
