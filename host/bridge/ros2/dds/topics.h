// The types of topics, for the templates of dds_node.h.
#pragma once

#include "host/bridge/ros2/dds/wire.h"

namespace edgescout::ros2 {

template <typename Wire>
const dds_topic_descriptor_t& descriptor();

#define EDGESCOUT_TOPIC(wire)                               \
  template <>                                               \
  inline const dds_topic_descriptor_t& descriptor<wire>() { \
    return wire##_desc;                                     \
  }
EDGESCOUT_TOPIC(sensor_msgs_msg_dds__Image_)
EDGESCOUT_TOPIC(sensor_msgs_msg_dds__CompressedImage_)
EDGESCOUT_TOPIC(sensor_msgs_msg_dds__CameraInfo_)
EDGESCOUT_TOPIC(tf2_msgs_msg_dds__TFMessage_)
EDGESCOUT_TOPIC(diagnostic_msgs_msg_dds__DiagnosticArray_)
EDGESCOUT_TOPIC(vision_msgs_msg_dds__Detection3DArray_)
EDGESCOUT_TOPIC(visualization_msgs_msg_dds__MarkerArray_)
EDGESCOUT_TOPIC(edgescout_msgs_msg_dds__DetectRequest_)
EDGESCOUT_TOPIC(edgescout_msgs_msg_dds__DetectResult_)
EDGESCOUT_TOPIC(edgescout_msgs_msg_dds__GetPoseEstimatesRequest_)
EDGESCOUT_TOPIC(edgescout_msgs_msg_dds__GetPoseEstimatesResult_)
EDGESCOUT_TOPIC(edgescout_msgs_msg_dds__ScoutProposeRequest_)
EDGESCOUT_TOPIC(edgescout_msgs_msg_dds__ScoutProposeResult_)
EDGESCOUT_TOPIC(edgescout_msgs_msg_dds__ScoutGiveRequest_)
EDGESCOUT_TOPIC(edgescout_msgs_msg_dds__ScoutGiveResult_)
EDGESCOUT_TOPIC(edgescout_msgs_msg_dds__ScoutStateRequest_)
EDGESCOUT_TOPIC(edgescout_msgs_msg_dds__ScoutStateResult_)
EDGESCOUT_TOPIC(edgescout_msgs_srv_dds__Detect_Request_)
EDGESCOUT_TOPIC(edgescout_msgs_srv_dds__Detect_Response_)
EDGESCOUT_TOPIC(edgescout_msgs_srv_dds__GetPoseEstimates_Request_)
EDGESCOUT_TOPIC(edgescout_msgs_srv_dds__GetPoseEstimates_Response_)
EDGESCOUT_TOPIC(edgescout_msgs_srv_dds__ScoutPropose_Request_)
EDGESCOUT_TOPIC(edgescout_msgs_srv_dds__ScoutPropose_Response_)
EDGESCOUT_TOPIC(edgescout_msgs_srv_dds__ScoutGive_Request_)
EDGESCOUT_TOPIC(edgescout_msgs_srv_dds__ScoutGive_Response_)
EDGESCOUT_TOPIC(edgescout_msgs_srv_dds__ScoutState_Request_)
EDGESCOUT_TOPIC(edgescout_msgs_srv_dds__ScoutState_Response_)
#undef EDGESCOUT_TOPIC

}  // namespace edgescout::ros2
