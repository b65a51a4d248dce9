// SPDX-License-Identifier: Apache-2.0
#include "window/layout_keeper.hpp"

#include <QScopedValueRollback>
#include <utility>

namespace cortex::gui {

namespace {

constexpr int saveAfter = 2'000;           // ms
const QLatin1String sizeOfWindow{"size"};  // of the window, in a layout

QStringList heard(const Frame& frame) {
    QStringList names;
    for (const AgentFrame& each : frame.agents) {
        if (!each.lost()) names << QString::fromStdString(each.status.name);
    }
    names.sort();
    return names;
}

}  // namespace

LayoutKeeper::LayoutKeeper(Layouts layouts, Arranged arranged, QObject* parent)
    : QObject{parent}, layouts_{std::move(layouts)}, arranged_{std::move(arranged)} {
    timer_.setSingleShot(true);
    timer_.setInterval(saveAfter);
    connect(&timer_, &QTimer::timeout, this, &LayoutKeeper::save);
}

void LayoutKeeper::begin(int domain, const QString& file) {
    domain_ = domain;
    first_ = arranged_.saved();
    first_.remove(sizeOfWindow);
    if (!file.isEmpty()) return open(file);
    begun_ = true;
    if (const auto layout = layouts_.newest(domain_)) restore(*layout);
    tellTroubles();
}

// Once all agents are known, the layout of just these is taken, unless the user has begun to work.
void LayoutKeeper::refresh(const Frame& frame) {
    if (!begun_ || frame.agents.empty()) return;
    if (frame.complete) agents_ = heard(frame);
    if (known_ || !frame.complete) return;
    known_ = true;
    if (worked_) return;
    const auto layout = layouts_.of(domain_, agents_);
    if (layout && *layout != last_) restore(*layout);
    tellTroubles();
}

void LayoutKeeper::restore(QJsonObject layout) {
    const QScopedValueRollback restoring{restoring_, true};
    last_ = layout;
    if (keepsSize_) layout.remove(sizeOfWindow);
    arranged_.restore(layout);
}

void LayoutKeeper::noteChange() {
    if (restoring_ || !begun_) return;
    worked_ = true;
    noteSize();
}

void LayoutKeeper::noteSize() {
    if (restoring_ || !begun_) return;
    changed_ = true;
    timer_.start();
}

void LayoutKeeper::save() {
    timer_.stop();
    if (!changed_ || agents_.isEmpty()) return;
    const QString why = layouts_.save(domain_, agents_, arranged_.saved());
    if (!why.isEmpty()) Q_EMIT told(tr("The layout was not saved: %1.").arg(why), true);
    changed_ = false;
}

void LayoutKeeper::saveAs(const QString& name) {
    const QString suffix = QStringLiteral(".json");
    const QString file = name.endsWith(suffix) ? name : name + suffix;
    const QString why = Layouts::write(file, domain_, agents_, arranged_.saved());
    Q_EMIT told(why.isEmpty() ? tr("The layout was saved as %1.").arg(file)
                              : tr("The layout was not saved as %1: %2.").arg(file, why),
                !why.isEmpty());
}

void LayoutKeeper::open(const QString& file) {
    if (const auto layout = layouts_.read(file)) {
        before_ = arranged_.saved();
        restore(*layout);
        noteChange();
    }
    tellTroubles();
}

void LayoutKeeper::reset() {
    before_ = arranged_.saved();
    restore(first_);
    noteChange();
}

void LayoutKeeper::goBack() {
    if (!before_) return;
    restore(*std::exchange(before_, arranged_.saved()));
    noteChange();
}

void LayoutKeeper::tellTroubles() {
    for (const QString& each : layouts_.takeTroubles()) Q_EMIT told(each, true);
}

}  // namespace cortex::gui
