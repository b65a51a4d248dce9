// SPDX-License-Identifier: Apache-2.0
#include "drive/drive_view.hpp"

#include "cortex/explorer/theme.hpp"

#include "drive/axis_band.hpp"
#include "drive/link_row.hpp"
#include "drive/transitions.hpp"
#include "motion/choices.hpp"

#include <QApplication>
#include <QScrollArea>
#include <QStyle>
#include <QVBoxLayout>
#include <algorithm>
#include <set>

namespace cortex::explorer {

namespace {

// The labels of the parameter `mode` of the command `setMode`, in the order of their numbers.
std::vector<int> modesOf(const Type& type) {
    std::vector<int> modes;
    const auto command = std::ranges::find(type.commands, "setMode", &Command::name);
    if (command == type.commands.end()) return modes;
    const auto mode = std::ranges::find(command->request, "mode", &DataItem::name);
    if (mode == command->request.end()) return modes;
    for (const auto& label : mode->labels) modes.push_back(static_cast<int>(label.first));
    return modes;
}

}  // namespace

DriveView::DriveView(std::string path)
    : path_{std::move(path)}, links_{new QVBoxLayout}, area_{new QScrollArea} {
    auto* content = new QWidget;
    column_ = new QVBoxLayout{content};
    column_->setContentsMargins(0, 0, 0, 0);
    column_->setSpacing(0);
    area_->setWidget(content);
    area_->setWidgetResizable(true);
    area_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    area_->setFocusPolicy(Qt::NoFocus);
    area_->setMinimumHeight(1);
    area_->setAccessibleName(tr("Axes"));
    links_->setSpacing(0);
    auto* all = new QVBoxLayout{this};
    all->setContentsMargins(0, 0, 0, 0);
    column_->addLayout(links_);
    column_->addStretch(1);
    all->addWidget(area_);
    connect(qApp, &QApplication::focusChanged, this,
            [this](QWidget* /*before*/, QWidget* now) { reveal(now); });
}

DriveView::~DriveView() { disconnect(qApp, nullptr, this, nullptr); }  // its parts lose the focus

// What has the keyboard is seen.
void DriveView::reveal(QWidget* now) {
    if (now != nullptr && area_->widget()->isAncestorOf(now))
        area_->ensureWidgetVisible(now, 0, units(8));
}

void DriveView::bind(const SystemNow& now) {
    const Type* type = now.at(path_).type();
    if (type == nullptr) return;
    auto axes = driveAxesOf(now, path_);
    auto modes = modesOf(*type);
    const bool same = std::ranges::equal(
        axes, axes_, [](const auto& one, const auto& other) { return one.isSame(other); });
    if (same && modes == modes_) return;
    axes_ = std::move(axes);
    modes_ = std::move(modes);
    makeBands(now);
    makeLinks();
    arrange();
}

void DriveView::makeBands(const SystemNow& now) {
    for (AxisBand* each : bands_) delete each;
    bands_.clear();
    delete choice_;
    choice_ = nullptr;
    chosen_ = frames_ = 0;
    std::vector<std::pair<QString, QString>> names;
    for (DriveAxis& each : axes_) {
        explorer::refresh(each, now, path_);
        auto* band = new AxisBand{each, path_, modes_};
        connect(band, &AxisBand::ordered, this,
                [this, band](const Order& wanted, const QString& title) {
                    order(wanted, title, band);
                });
        connect(band, &AxisBand::opened, this,
                [this](const QString& path) { Q_EMIT opened(path.toStdString()); });
        column_->insertWidget(column_->count() - 1, band);
        bands_.push_back(band);
        names.emplace_back(QString::number(each.number), tr("Axis %1").arg(each.number));
    }
    if (axes_.size() < 2) return;
    choice_ = new Choices{names};
    connect(choice_, &Choices::wanted, this,
            [this](const QString& name) { showAxis(name.toInt() - 1); });
    choice_->setContentsMargins(units(2), units(1), units(2), units(1));
    column_->insertWidget(0, choice_);
}

// One row for each device, whichever axes it has.
void DriveView::makeLinks() {
    for (LinkRow* each : linkRows_) delete each;
    linkRows_.clear();
    std::set<std::string> devices;
    for (const DriveAxis& each : axes_) {
        if (each.device.empty() || !each.linked || !devices.insert(each.device).second) continue;
        auto* row = new LinkRow{each.device, true};
        connect(row, &LinkRow::reconnectWanted, this, [this, row] { reconnect(row); });
        connect(row, &LinkRow::opened, this,
                [this](const QString& path) { Q_EMIT opened(path.toStdString()); });
        links_->addWidget(row);
        linkRows_.push_back(row);
    }
}

std::vector<Watch> DriveView::watches() const {
    Watch watch{{path_}};
    for (const DriveAxis& each : axes_) {
        for (const std::string& path :
             {each.observation, each.setpoint, each.demand, each.device}) {
            if (!path.empty()) watch.prefixes.push_back(path);
        }
    }
    return {watch};
}

void DriveView::refresh(const SystemNow& now) {
    const auto ask = [this](const char* command) { return whyNot(path_, command); };
    const Homing homing = homingOf(now.at(path_));
    for (DriveAxis& each : axes_) explorer::refresh(each, now, path_);
    for (std::size_t i = 0; i < bands_.size(); ++i) {
        const DriveAxis& axis = axes_[i];
        const bool homes = homing.isOf(axis, axes_);
        BandLook look{
            reasonsOf(axis, homing, homes, ask), homing, homes, whyNot(path_, "cancel"), {}};
        for (std::size_t n = 0; n < look.shown.size(); ++n)
            look.shown[n] = shownNumber(shownUnit(axis.numbers[n].unit));
        bands_[i]->show(axis, look);
    }
    ++frames_;
    for (LinkRow* each : linkRows_) each->refresh(now, whyNot(each->device(), "reconnect"));
    if (choice_ == nullptr) return;
    for (const DriveAxis& each : axes_) {
        const QString state = nameOfState(each.state);
        choice_->rename(
            QString::number(each.number),
            tr("Axis %1: %2").arg(each.number).arg(each.live() ? state : '[' + state + ']'));
    }
    arrange();
}

// --- orders -----------------------------------------------------------------------------------

void DriveView::order(const Order& order, const QString& title, AxisBand* band) {
    band->say(tr("%1: sending").arg(title));
    send(order, [title, band = QPointer<AxisBand>{band}](const Answer& answer) {
        if (band) band->say(tr("%1: %2").arg(title, answer.text));
    });
}

void DriveView::reconnect(LinkRow* row) {
    row->say(tr("Reconnect: sending"));
    send({row->device(), "reconnect"}, [row = QPointer<LinkRow>{row}](const Answer& answer) {
        if (row) row->say(tr("Reconnect: %1").arg(answer.text));
    });
}

// --- layout -----------------------------------------------------------------------------------

void DriveView::showAxis(int axis) {
    chosen_ = std::clamp(axis, 0, std::max(0, count() - 1));
    arrange();
}

void DriveView::arrange() {
    if (bands_.empty()) return;
    const int scrollBar = style()->pixelMetric(QStyle::PM_ScrollBarExtent, nullptr, area_);
    const int room = width() - scrollBar;
    const bool narrow = room < bands_.front()->widthOfAll();
    for (AxisBand* each : bands_) each->arrange(room);
    if (choice_ != nullptr) {
        choice_->setVisible(narrow);
        keepChoice(room);
        choice_->show(QString::number(chosen_ + 1));
    }
    for (int i = 0; i < count(); ++i) band(i).setVisible(!narrow || i == chosen_);
}

// As wide as with the longest state, where there is room for that.
void DriveView::keepChoice(int room) {
    int width = 0;
    for (const auto& row : drives::ds402States) {
        const QString text = tr("Axis %1: %2").arg(count()).arg('[' + nameOfState(row.state) + ']');
        width = std::max(width, choice_->fontMetrics().horizontalAdvance(text) + units(5));
    }
    choice_->keepWidth(std::min(width, (room - units(4)) / std::max(count(), 1) - units(0.5)));
}

void DriveView::resizeEvent(QResizeEvent* /*event*/) { arrange(); }

}  // namespace cortex::explorer
