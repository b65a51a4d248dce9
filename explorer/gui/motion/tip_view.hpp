// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "motion/axis_rows.hpp"
#include "motion/jog.hpp"
#include "motion/tip.hpp"

#include <string>
#include <vector>

namespace cortex::explorer {

class MotionBar;
class MotionPage;
class TipNumbers;
class TipPad;

// The tip of a chain under a CartesianJogController: where it is, how its axes are, and jogging
// along and about the axes of the base or of the tip while a button or key is held.
class TipView : public View {
    Q_OBJECT
public:
    explicit TipView(std::string path);

    void bind(const SystemNow& now) override;
    void refresh(const SystemNow& now) override;
    std::vector<Watch> watches() const override;
    bool settled() const override;  // there is something of the past to see

private:
    void connectParts();
    void press(int motion, int direction, QWidget* held);
    void setFrame(const QString& frame);
    void choose(int axis);
    double speedOf(int motion) const;
    QString whyNoJog() const;

    void showBar();
    void showRows();
    void showLines();
    QString jogSentence() const;
    QString heldBackBy() const;
    QString help() const;
    QString limitSentence() const;
    ShownNumber shown(const std::string& unit) const;
    ShownNumber shownOf(int motion) const;  // its velocity

    std::string path_;
    Tip tip_;
    std::vector<MotionAxis> axes_;
    QString whyNot_;  // of jog
    bool bound_ = false;

    MotionBar* bar_;
    TipPad* pad_;
    TipNumbers* numbers_;
    AxisRows* rows_;
    MotionPage* page_;
    Jog* jog_;
};

}  // namespace cortex::explorer
