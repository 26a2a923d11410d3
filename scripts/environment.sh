# What every script that builds or runs ROS needs; to be sourced.

# ROS asks the machine for its own name, which a container may not be able to resolve.
if getent hosts localhost > /dev/null; then
  export ROS_HOSTNAME=localhost
else
  export ROS_HOSTNAME=127.0.0.1
  export ROS_MASTER_URI=http://127.0.0.1:11311
fi
# Messages with an accent in them must not stop Python's tools.
export LC_ALL=C.UTF-8
# rviz under Xvfb: no session bus, no GPU.
export LIBGL_ALWAYS_SOFTWARE=${LIBGL_ALWAYS_SOFTWARE:-1} QT_X11_NO_MITSHM=1
