# What every script that builds or runs ROS needs; to be sourced.

# ROS asks the machine for its own name, which a container may not be able to resolve. The master is this
# machine's, whatever robot the caller's shell is set up for.
if getent hosts localhost > /dev/null; then
  export ROS_HOSTNAME=localhost
else
  export ROS_HOSTNAME=127.0.0.1
fi
export ROS_MASTER_URI=http://$ROS_HOSTNAME:11311
# Messages with an accent in them must not stop Python's tools.
export LC_ALL=C.UTF-8
