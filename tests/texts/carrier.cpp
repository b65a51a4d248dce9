// SPDX-License-Identifier: Apache-2.0
// A plug-in whose class carries values: from `a` of another simplex to its own `aCopy`, and from
// what a command asks to what it answers.
#include "cortex/core/registry.hpp"
#include "cortex/cs/simplex_cs.hpp"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <string_view>
#include <vector>

namespace {

class Carrier final : public cortex::cs::SimplexCS {
public:
    using SimplexCS::SimplexCS;

private:
    void populate() override {
        for (const auto& source : inputs("source")) {
            for (const cortex::DataItem& item : type().data) addItem(source, item);
        }
        on<&Carrier::echo>("echo");
        asked_ = {argument<std::int64_t>("echo", "count"), argument<double>("echo", "number"),
                  argument<bool>("echo", "flag"), argument<std::string_view>("echo", "text"),
                  arrayArgument<double>("echo", "numbers")};
        said_ = {result<std::int64_t>("echo", "count"), result<double>("echo", "number"),
                 result<bool>("echo", "flag"), result<std::string_view>("echo", "text"),
                 arrayResult<double>("echo", "numbers")};
    }
    void loopEnd(const cortex::Tick&) override {
        for (const auto& copy : copies_) copy();
    }

    void addItem(const cortex::InputSimplex& source, const cortex::DataItem& item) {
        constexpr std::string_view end = "Copy";
        if (!item.name.ends_with(end)) return;
        const std::string_view from = std::string_view{item.name}.substr(0, item.name.size() - 4);
        switch (item.kind) {
            case cortex::Kind::Int:
                return add<std::int64_t>(source, item, from);
            case cortex::Kind::Float:
                return add<double>(source, item, from);
            case cortex::Kind::Bool:
                return add<bool>(source, item, from);
            case cortex::Kind::String:
                return add<std::string_view>(source, item, from);
        }
    }
    template <class T>
    void add(const cortex::InputSimplex& source, const cortex::DataItem& item,
             std::string_view from) {
        if (item.length == 1) {
            copies_.push_back([to = data<T>(item.name), from = source.data<T>(from)]() mutable {
                to = from.get();
            });
            return;
        }
        copies_.push_back([to = array<T>(item.name), from = source.array<T>(from)] {
            for (std::size_t i = 0; i < to.size(); ++i) to[i] = static_cast<T>(from[i]);
        });
    }

    cortex::Outcome echo(cortex::Call& call) {
        call[said_.count] = call[asked_.count].get();
        call[said_.number] = call[asked_.number].get();
        call[said_.flag] = call[asked_.flag].get();
        call[said_.text] = call[asked_.text].get();
        std::ranges::copy(call[asked_.numbers], call[said_.numbers].begin());
        return cortex::Outcome::Done;
    }

    struct Asked {
        cortex::Argument<std::int64_t> count;
        cortex::Argument<double> number;
        cortex::Argument<bool> flag;
        cortex::Argument<std::string_view> text;
        cortex::ArrayArgument<double> numbers;
    };
    struct Said {
        cortex::Result<std::int64_t> count;
        cortex::Result<double> number;
        cortex::Result<bool> flag;
        cortex::Result<std::string_view> text;
        cortex::ArrayResult<double> numbers;
    };
    std::vector<std::function<void()>> copies_;
    Asked asked_;
    Said said_;
};

void addClasses(cortex::ClassRegistry& registry) { registry.add<Carrier>("Carrier"); }

}  // namespace

CORTEX_PLUGIN(addClasses, {"Carrier", ""})
