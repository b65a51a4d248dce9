// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/explorer/view.hpp"

#include <string>

class QLabel;

namespace cortex::explorer {

class LinkRow;
class Sentence;
class SmallPlot;

// The link of a FieldbusDevice: how it is, how long its exchanges take, and how old the last
// answer was during the last ten seconds.
class FieldbusView : public View {
    Q_OBJECT
public:
    explicit FieldbusView(std::string path);

    void refresh(const SystemNow& now) override;
    std::vector<Watch> watches() const override { return {{{path_}}}; }
    bool settled() const override;  // there is something of the past to see
    LinkRow& link() const { return *link_; }

private:
    void reconnect();

    std::string path_;
    LinkRow* link_;
    Sentence* times_;
    SmallPlot* age_;
    double began_ = 0, now_ = 0;  // s
};

}  // namespace cortex::explorer
