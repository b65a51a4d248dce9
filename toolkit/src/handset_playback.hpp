// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/cs/simplex_cs.hpp"
#include "cortex/toolkit/recorded_path.hpp"

#include "handles.hpp"
#include "keyboard_hand.hpp"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace cortex::toolkit {

// A handset whose hand is a recorded path, or the keyboard. Plays while Active.
class HandsetPlayback final : public cs::SimplexCS {
public:
    using SimplexCS::SimplexCS;

private:
    enum Source : std::int64_t { File, Keyboard };

    void populate() override;
    bool stateStartingUp(const Tick& tick) override;
    void stateActive(const Tick& tick) override;
    void loopEnd(const Tick& tick) override;
    void keep(Archive& archive) override;

    std::string pathOfFile();
    void play();
    void moveByKeyboard(const Tick& tick);

    std::optional<RecordedPath> path_;
    std::unique_ptr<KeyboardHand> keyboard_;
    PoseOutput poseOutput_;
    std::vector<Data<bool>> buttons_;
    Data<double> time_;
    Data<bool> finished_;
    std::int64_t startedAt_ = 0;
    Pose pose_;
    Twist velocity_ = Twist::Zero();
};

}  // namespace cortex::toolkit
