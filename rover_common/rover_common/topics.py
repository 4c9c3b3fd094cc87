"""Names of the topics, relative to the nodes' namespace."""

IMAGE = "camera/image_raw"  # sensor_msgs/Image, rgb8
COMPRESSED_IMAGE = "camera/image_raw/compressed"  # sensor_msgs/CompressedImage, JPEG
CAMERA_INFO = "camera/camera_info"  # sensor_msgs/CameraInfo
ODOMETRY = "odom"  # nav_msgs/Odometry
STATUS = "rover_status"  # rover_interfaces/RoverStatus
WORLDMAP = "worldmap"  # nav_msgs/OccupancyGrid, latched
NAVIGATION_MAP = "navigation_map"  # nav_msgs/OccupancyGrid, latched, of finer cells
NAV_POLAR = "nav_polar"  # rover_interfaces/PolarArray
ROCK_POLAR = "rock_polar"  # rover_interfaces/PolarArray
FREE_SCAN = "free_scan"  # sensor_msgs/LaserScan
ROCKS = "rocks"  # rover_interfaces/RockTrackArray, latched
VISION_IMAGE = "vision_image"  # sensor_msgs/Image, rgb8
BIRDSEYE_IMAGE = "birdseye_image"  # sensor_msgs/Image, rgb8, the same seen from above
BRIDGE_STATE = "bridge_state"  # std_msgs/String, latched: connected or disconnected
COMMAND = "cmd_drive"  # rover_interfaces/DriveCommand
DRIVER = "driver"  # std_msgs/String, latched: manual, cmd_vel, decision or nobody
MISSION_STATE = "mission_state"  # rover_interfaces/MissionState, latched
PLAN = "plan"  # nav_msgs/Path
MISSION_MARKERS = "mission_markers"  # visualization_msgs/MarkerArray

# Velocities, geometry_msgs/Twist or TwistStamped; the second robot has no other command
CMD_VEL = "cmd_vel"
CMD_VEL_TELEOP = "cmd_vel_teleop"  # of a person, whom the first robot obeys before all others

# Of the second robot
SCAN = "scan"  # sensor_msgs/LaserScan
IMU = "imu"  # sensor_msgs/Imu
TEMPERATURE_1 = "temperature_sensor_1"  # std_msgs/Float32MultiArray, 64 values row by row
TEMPERATURE_2 = "temperature_sensor_2"  # the same
FLYWHEEL = "flywheel"  # std_msgs/Int32, a number above 0 begins a sequence
FLYWHEEL_STATUS = "flywheel_status"  # std_msgs/String, when a sequence has ended
SENSOR_TICK = "sensor_tick"  # rover_interfaces/SensorTick, in lockstep
MISSION_TICK = "mission_tick"  # std_msgs/Header, the mission's answer to a tick
MAP = "map"  # nav_msgs/OccupancyGrid, latched
HAZARD_MAP = "hazard_map"  # the same with blocked places in it, latched
NAVIGATE = "navigate_to_pose"  # the action nav2_msgs/NavigateToPose
NAVIGATION_TICK = "navigation_tick"  # rover_interfaces/NavigationTick, in lockstep
HEAT_SOURCES = "heat_sources"  # rover_interfaces/HeatSourceArray, latched
HEAT_STATE = "heat_state"  # rover_interfaces/HeatState, latched
HEAT_MARKERS = "heat_markers"  # visualization_msgs/MarkerArray
