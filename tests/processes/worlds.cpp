// SPDX-License-Identifier: Apache-2.0
// A plug-in of worlds that have a model as text, and print on the standard output beside it.
#include "cortex/core/registry.hpp"
#include "cortex/cs/io_exchange.hpp"

#include "model_text.hpp"

#include <cstdint>
#include <cstdio>
#include <iostream>
#include <string>

namespace {

class World final : public cortex::cs::SimplexCS, public cortex::toolkit::HasModelText {
public:
    using SimplexCS::SimplexCS;
    std::string modelText() const override {
        std::string text = "<mujoco model=\"" + path() + "\">\n";
        for (std::int64_t i = 0; i < bodies_; ++i) text += "  <body/>\n";
        return text + "</mujoco>";
    }

private:
    void populate() override {
        bodies_ = data<const std::int64_t>("bodies");
        std::puts("a world is made");
        std::cout << "of so many bodies: " << bodies_.get() << std::endl;
    }
    void loopStart(const cortex::Tick&) override { std::fputs("it runs\n", stderr); }

    cortex::Data<const std::int64_t> bodies_;
};

struct Nothing {};

class Line final : public cortex::cs::IoSimplex<Nothing, Nothing> {
public:
    using IoSimplex::IoSimplex;

private:
    void communicate(IoSimplex::Line& line) override {
        std::fputs("it talks\n", stderr);
        while (line.waitFor(std::chrono::seconds{1})) {
        }
    }
};

void addClasses(cortex::ClassRegistry& registry) {
    registry.add<World>("World");
    registry.add<Line>("Line");
}

}  // namespace

CORTEX_PLUGIN(addClasses, {"World", ""}, {"Line", ""})
