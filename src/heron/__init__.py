"""The robot of the thesis in MuJoCo, its safety rules, and its experiments.

A robot modelled on Heron drives in a physics simulation. Its sensors and its commands are ROS
topics with names and types. Safety rules written in ROSSMARie guard the robot.
"""
