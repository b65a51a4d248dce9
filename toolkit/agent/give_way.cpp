// SPDX-License-Identifier: Apache-2.0
#include "give_way.hpp"

#include <iostream>
#include <utility>
#include <vector>

namespace cortex::toolkit {

GiveWay::GiveWay(cs::ClusterCS& cluster, std::string agentName, bool startsUp)
    : cluster_{cluster}, name_{std::move(agentName)}, startsUp_{startsUp} {}

GiveWay::Turn GiveWay::look(bool isSecond) {
    if (isSecond && !std::exchange(away_, true)) leave();
    if (!away_) return Turn::Ours;
    CallResult answer;
    if (sent_ != 0 && cluster_.program().poll(sent_, answer)) {
        sent_ = 0;
        if (!answer.done()) std::cerr << "shutdown: " << answer.text() << std::endl;
    }
    if (isSecond || sent_ != 0) return Turn::Theirs;
    comeBack();
    return Turn::OursAgain;
}

void GiveWay::leave() {
    std::cerr << "another start of " << name_
              << " has the devices: everything here goes to Standby until that one has ended; end "
                 "one of the two"
              << std::endl;
    sent_ =
        cluster_.send("/" + name_, "shutdown", {{"prefix", Value{std::vector<std::string>{"/"}}}});
}

void GiveWay::comeBack() {
    away_ = false;
    std::cerr << "the other start of " << name_ << " has ended: "
              << (startsUp_
                      ? "everything is started up, as --startup says"
                      : "everything is in Standby; cortex call /" + name_ + " startup prefix=/")
              << std::endl;
}

}  // namespace cortex::toolkit
