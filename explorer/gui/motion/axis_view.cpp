// SPDX-License-Identifier: Apache-2.0
#include "motion/axis_view.hpp"

#include "cortex/explorer/small_plot.hpp"

#include "motion/axis_plots.hpp"
#include "motion/choices.hpp"
#include "motion/demand_bar.hpp"
#include "motion/motion_bar.hpp"
#include "motion/motion_page.hpp"

#include <QPushButton>
#include <QVBoxLayout>
#include <algorithm>
#include <array>

namespace cortex::explorer {

namespace {

constexpr double leastHeight = 50;  // units; below it the demands are scrolled with the axes

constexpr std::array modes{"Hold", "Position", "Velocity", "Step"};

}  // namespace

AxisView::AxisView(std::string path)
    : path_{std::move(path)},
      rows_{new AxisRows},
      demands_{new DemandBar},
      jog_{new Jog{
          [this](int axis, double velocity) {
              return Order{
                  path_, "jog", {{"axis", std::int64_t{axis} + 1}, {"velocity", velocity}}};
          },
          [this](QWidget& held, const HeldOrder& order) { return hold(held, order); }, this}} {}

// Once it is known what the controller is.
void AxisView::build() {
    using Choice = std::pair<QString, QString>;
    std::vector<Choice> choices;
    if (jogs_)
        choices = {{QStringLiteral("Velocity"), tr("Velocity")},
                   {QStringLiteral("Position"), tr("Position")}};
    bar_ = new MotionBar{tr("Mode"), choices};
    auto* low = new QWidget;
    low_ = new QVBoxLayout{low};
    low_->setContentsMargins(0, 0, 0, 0);
    page_ = new MotionPage{{bar_, rows_, low}, jogs_};
    whole_ = new QVBoxLayout{this};
    whole_->setContentsMargins(0, 0, 0, 0);
    whole_->setSpacing(0);
    whole_->addWidget(page_, 1);
    demands_->setVisible(!jogs_);  // until its mode is known
    arrange();
    connectParts();
}

// The demands stand still below the axes: what came of them is seen wherever these are scrolled.
void AxisView::arrange() {
    if (whole_ == nullptr) return;
    QVBoxLayout* place = height() < units(leastHeight) ? low_ : whole_;
    if (place->indexOf(demands_) < 0) place->addWidget(demands_);
}

void AxisView::resizeEvent(QResizeEvent* /*event*/) { arrange(); }

void AxisView::connectParts() {
    connect(rows_, &AxisRows::chosen, this, &AxisView::choose);
    connect(rows_, &AxisRows::pressed, this, &AxisView::press);
    connect(rows_, &AxisRows::edited, this, &AxisView::enter);
    connect(bar_, &MotionBar::shareChanged, this, [this] {
        if (jog_->runs()) jog_->change(jog_->direction() * speedOf(jog_->axis()));
    });
    connect(&bar_->modes(), &Choices::wanted, this, &AxisView::setMode);
    for (Choices* each : {&bar_->angles(), &bar_->lengths()}) {
        connect(each, &Choices::wanted, this,
                [this](const QString& unit) { chooseUnit(unit.toStdString()); });
    }
    connect(&demands_->copyButton(), &QPushButton::clicked, this, &AxisView::copyCurrent);
    connect(&demands_->discardButton(), &QPushButton::clicked, this,
            [this] { demands_->discard(); });
    connect(&demands_->moveButton(), &QPushButton::clicked, this, &AxisView::move);
    connect(&demands_->haltButton(), &QPushButton::clicked, this, [this] {
        send({path_, jogs_ ? "halt" : "cancel"}, [this](const Answer& answer) {
            if (!answer.done) demands_->say(answer.text);  // otherwise the motion tells it
        });
    });
}

void AxisView::bind(const SystemNow& now) {
    const Type* type = now.at(path_).type();
    if (type == nullptr) return;
    jogs_ = type->isA("JogController");
    item_ = jogs_ ? "demandPosition" : "pose";
    if (bar_ == nullptr) build();
    const DataItem* item = type->findData(item_);
    sent_.assign(item != nullptr ? item->length : 0, 0.0);
    auto axes = axesOf(now, path_);
    // What is held down must outlast what comes and goes elsewhere.
    const bool same = std::ranges::equal(
        axes, axes_, [](const auto& one, const auto& other) { return one.isSame(other); });
    if (same && bound_) return;
    bound_ = true;
    axes_ = std::move(axes);
    rows_->make(axes_, jogs_ ? RowPart::Jog : RowPart::Demand, jogs_);
    demands_->forget(axes_.size());
    page_->plots().forget(axes_.size());
    const auto has = [&](bool linear) {
        return std::ranges::any_of(axes_,
                                   [&](const auto& each) { return each.isLinear() == linear; });
    };
    bar_->angles().setVisible(has(false));
    bar_->lengths().setVisible(has(true));
}

std::vector<Watch> AxisView::watches() const {
    Watch watch{{path_}};
    for (const MotionAxis& each : axes_) {
        for (const std::string& path : {each.axis, each.demand, each.device}) {
            if (!path.empty()) watch.prefixes.push_back(path);
        }
    }
    return {watch};
}

bool AxisView::settled() const { return axes_.empty() || page_->settled(); }

void AxisView::takeIn(const SystemNow& now) {
    const SimplexNow controller = now.at(path_);
    for (MotionAxis& each : axes_) explorer::refresh(each, now);
    for (std::size_t i = 0; i < sent_.size(); ++i) {
        sent_[i] = controller.number(item_, i).value_or(sent_[i]);
    }
    holdTime_ = controller.number("holdTime").value_or(0);
    given_ = controller.text("targetGiven") == QLatin1String{"true"};
    remaining_ = controller.number("remaining");
    const auto mode = controller.number("mode");
    const auto known = mode ? static_cast<std::size_t>(*mode) : modes.size();
    mode_ = known < modes.size() ? QLatin1String{modes[known]} : QString{};
    whyNot_ = whyNot(path_, jogs_ ? "jog" : "moveTo");
    bar_->setAllowed(whyNot_.isEmpty());
}

void AxisView::refresh(const SystemNow& now) {
    if (bar_ == nullptr) return;
    takeIn(now);
    if (jog_->runs() && axis(jog_->axis()).isAtLimit(jog_->direction())) {
        jog_->end(axis(jog_->axis()).limitText());
    }
    const SimplexNow controller = now.at(path_);
    if (controller.live()) jog_->see(controller.text("jogging") == QLatin1String{"true"});
    if (jogs_) {
        rows_->setPart(mode_ == QLatin1String{"Position"} ? RowPart::Demand : RowPart::Jog);
        bar_->modes().show(mode_);
        bar_->modes().setWhyNot(whyNot_);
    }
    showTitles();
    showRows();
    showDemands();
    showLines();
    page_->plots().add(axes_, SmallPlot::clock());
    if (rows_->count() == 0) return;
    const MotionAxis& chosen = axis(rows_->selected());
    page_->plots().show(chosen, static_cast<std::size_t>(rows_->selected()), positionOf(chosen),
                        velocityOf(chosen));
}

}  // namespace cortex::explorer
