// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "made_agent.hpp"
#include "plots/plot_view.hpp"
#include "record/recorder.hpp"

#include <QApplication>
#include <QImage>
#include <cmath>
#include <functional>
#include <memory>

#include <gtest/gtest.h>

namespace cortex::test {

using namespace gui;

// A plot of an agent that is made by hand: a drive that is observed and demanded, and a switch.
class Plotted : public testing::Test {
protected:
    explicit Plotted(std::size_t capacity = Ring::full) : recorder{capacity} {
        view.resize(1000, 700);
        view.show();
    }

    // So many cycles of 1 ms, in which the position is what the function says.
    void run(int cycles, const std::function<double(double)>& motion) {
        for (int i = 0; i < cycles; ++i) {
            const double seconds = static_cast<double>(agent.cycle() + 1) * 1e-3;
            agent.put("/axes/1", "position", motion(seconds));
            agent.put("/demands/1", "position", motion(seconds));
            recorder.hear("far", *agent.now().image);
        }
    }
    void show() {
        recorder.take();
        view.refresh(frameOf({agent.now()}));
        view.redraw();
        QApplication::processEvents();
    }
    DrawnLine line(int tag) const {
        for (const DrawnLine& each : view.drawn()) {
            if (each.line.tag == tag) return each;
        }
        return {};
    }
    QImage picture() { return view.grab().toImage(); }

    MadeAgent agent{"far", [](SimplexTree& tree) {
                        tree.add("/axes/1", "Observation");
                        tree.add("/demands/1", "Demand");
                        tree.add("/switch", "Switches");
                        tree.add("/probe", "SettledProbe");
                    }};
    RecordedItem position{{}, "/axes/1", "position", 0};
    RecordedItem demand{{}, "/demands/1", "position", 0};
    RecordedItem velocity{{}, "/demands/1", "velocity", 0};
    RecordedItem mode{{}, "/switch", "mode", 0};
    Recorder recorder;
    PlotView view{recorder};
};

}  // namespace cortex::test
