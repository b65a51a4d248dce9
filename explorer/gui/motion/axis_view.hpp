// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "motion/axis_rows.hpp"
#include "motion/jog.hpp"

#include <memory>
#include <string>
#include <vector>

class QVBoxLayout;

namespace cortex::explorer {

class DemandBar;
class MotionBar;
class MotionPage;

// The axes of a JogController or an AxisPoseController: how they are, jogging while a button or key
// is held, and demands that are entered and sent together.
class AxisView : public View {
    Q_OBJECT
public:
    explicit AxisView(std::string path);

    void bind(const SystemNow& now) override;
    void refresh(const SystemNow& now) override;
    std::vector<Watch> watches() const override;
    bool settled() const override;  // there is something of the past to see

protected:
    void resizeEvent(QResizeEvent* event) override;

private:
    void build();
    void connectParts();
    void arrange();

    void takeIn(const SystemNow& now);
    void showRows();
    void showRow(int axis);
    void showLines();
    void showDemands();
    void showTitles();

    void choose(int axis);
    void press(int axis, int direction, QWidget* held);
    QString whyNoJog(int axis) const;
    QString limitSentence() const;
    QString speedText() const;
    double speedOf(int axis) const;

    void enter(int axis);
    void copyCurrent();
    void move();
    void go(int axis, int motion);
    void tell(int motion, const Answer& answer);  // what came of it
    void setMode(const QString& mode);

    ShownNumber positionOf(const MotionAxis& axis) const;
    ShownNumber velocityOf(const MotionAxis& axis) const;
    const MotionAxis& axis(int index) const { return axes_[static_cast<std::size_t>(index)]; }
    std::optional<double> demandOf(int axis) const;  // as entered, otherwise as it was sent
    bool hasTarget() const;               // somebody gave what Move would go to, or entered it here
    QString wrongDemand(int axis) const;  // why it is refused; empty: nothing is wrong

    std::string path_, item_;  // of the demands: "demandPosition", "pose"
    bool jogs_ = true;         // false: an AxisPoseController
    bool bound_ = false, unitsInRows_ = false;
    bool given_ = false;  // sent_ is what somebody gave; otherwise it is where the axes are
    std::vector<MotionAxis> axes_;
    std::vector<double> sent_;  // demands as the controller has them
    QString mode_, whyNot_;     // of jog
    double holdTime_ = 0;
    std::optional<double> remaining_;

    MotionBar* bar_ = nullptr;
    AxisRows* rows_;
    DemandBar* demands_;
    MotionPage* page_ = nullptr;
    QVBoxLayout *whole_ = nullptr, *low_ = nullptr;  // where the demands stand
    Jog* jog_;
};

}  // namespace cortex::explorer
