// SPDX-License-Identifier: Apache-2.0
#include "mujoco_model.hpp"

#include "cortex/core/error.hpp"

#include "mujoco_errors.hpp"

#include <cstddef>
#include <cstring>
#include <mutex>

namespace cortex::physics {
namespace {

constexpr const char* fileName = "scene.xml";
constexpr std::size_t pageSize = 4096;

void touch(void* memory, std::size_t size) {
    auto* bytes = static_cast<volatile std::byte*>(memory);
    for (std::size_t i = 0; i < size; i += pageSize) bytes[i] = bytes[i];
}

struct DeleteFiles {
    void operator()(mjVFS* files) const {
        mj_deleteVFS(files);
        delete files;
    }
};

}  // namespace

MujocoModel loadModel(const std::string& mjcf) {
    static std::mutex oneAtATime;  // its parser remembers the newest model
    const std::scoped_lock lock{oneAtATime};
    handleMujocoErrors();
    const std::unique_ptr<mjVFS, DeleteFiles> files{new mjVFS};
    mj_defaultVFS(files.get());
    if (mj_makeEmptyFileVFS(files.get(), fileName, static_cast<int>(mjcf.size())) != 0)
        throw Error("MuJoCo has no room for the text of the scene");
    std::memcpy(files->filedata[mj_findFileVFS(files.get(), fileName)], mjcf.data(), mjcf.size());

    MujocoText error{};
    MujocoModel model{mj_loadXML(fileName, files.get(), error.data(), error.size())};
    if (!model) throw Error("MuJoCo refuses the scene: " + std::string{error.data()});
    return model;
}

MujocoData makeData(const mjModel& model) {
    struct Made {
        const mjModel* model;
        mjData* data = nullptr;
    } made{&model};
    MujocoText error{};
    const bool ended = guarded(
        [](void* argument) {
            auto* const to = static_cast<Made*>(argument);
            to->data = mj_makeData(to->model);
        },
        &made, error);
    MujocoData data{made.data};
    if (!ended || !data) throw Error("MuJoCo cannot hold the scene: " + std::string{error.data()});
    touch(data->buffer, static_cast<std::size_t>(data->nbuffer));
    touch(data->stack, static_cast<std::size_t>(data->nstack) * sizeof(mjtNum));
    return data;
}

}  // namespace cortex::physics
