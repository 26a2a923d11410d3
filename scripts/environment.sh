# What every script that builds or runs ROS needs; to be sourced.

# ROS asks the machine for its own name, which a container may not be able to resolve. The master is this
# machine's, whatever robot the caller's shell is set up for.
export ROS_HOSTNAME=localhost
export ROS_MASTER_URI=http://$ROS_HOSTNAME:11311
# Messages with an accent in them must not stop Python's tools.
export LC_ALL=C.UTF-8
