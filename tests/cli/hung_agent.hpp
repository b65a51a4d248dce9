// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

namespace cortex::test {

// The agent "robot" in this process, on loopback, with one task, /ctl, that does not return from
// its hook while it is told so, or takes three periods, or says and does what it is told.
class HungAgent {
public:
    explicit HungAgent(int domain);
    ~HungAgent();

    void hang();                         // returns when its watchdog has seen it
    void release();                      // returns when its watchdog has seen it
    void overload();                     // returns when its loop says so
    void fail(const std::string& text);  // its task goes to Fault 7 with this text
    void chatter(int events);  // returns when it has said so many things, each with other words

private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation_;
};

}  // namespace cortex::test
