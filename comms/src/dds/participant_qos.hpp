// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/comms/network_options.hpp"

#include "dds/topics.hpp"

#include <string>

#include <fastdds/dds/domain/qos/DomainParticipantQos.hpp>
#include <fastdds/dds/publisher/qos/DataWriterQos.hpp>
#include <fastdds/dds/subscriber/qos/DataReaderQos.hpp>

// The settings with which Fast DDS is used.
namespace cortex::comms {

// Throws Error if this machine cannot provide what the options ask for.
eprosima::fastdds::dds::DomainParticipantQos participantQos(const NetworkOptions& options,
                                                            const std::string& name);
// Whether, with security, a thread of Fast DDS sends samples of such topics.
bool isSentByThread(Qos qos);
// While one reader lacks a sample, Fast DDS sends heartbeats to all readers, and all answer. So
// heartbeats are less frequent in a crowd. `othersOnHost`: participants in the domain.
eprosima::fastdds::dds::DataWriterQos writerQos(Qos qos, int othersOnHost = 0,
                                                bool secured = false);
eprosima::fastdds::dds::DataReaderQos readerQos(Qos qos, int othersOnHost = 0);

// Takes effect once for the whole process. It turns the log of Fast DDS off unless CORTEX_DDS_LOG
// is set, and lets two participants of one process talk as those of two processes do.
void setUpFastDds();

}  // namespace cortex::comms
